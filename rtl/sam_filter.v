// Box filter: the average of the primary pixels that fall in one secondary pixel, up to 29 of them.
//
// Latency: one clock from the pixel's last beat. Sums, count and the reciprocal of the count are
// the only registers; the division follows them.
// Reset: rst_i clears valid_q; sums and count start afresh at the first beat of a pixel.
// Paper: sections 5.6 and 5.6.1.
`include "sam_formats.vh"
`default_nettype none

module sam_filter #(
    // Division by n: 2 or 3 for 1/n as so many powers of two, 0 for an exact one.
    parameter FILTER_TERMS = 0
) (
    input  wire                       clk_i,
    input  wire                       rst_i,

    input  wire                       beat_valid_i,
    output wire                       beat_ready_o,
    input  wire                       beat_first_i,
    input  wire                       beat_end_i,
    input  wire                       beat_include_i,
    input  wire [`SAM_RGBA_BITS-1:0]  beat_rgba_i,

    output wire                       pixel_valid_o,
    input  wire                       pixel_ready_i,
    output wire [`SAM_RGBA_BITS-1:0]  pixel_rgba_o,
    output wire [`SAM_COUNT_BITS-1:0] pixel_count_o
);
    localparam N        = `SAM_COUNT_BITS;
    localparam CHANNELS = `SAM_RGBA_BITS / `SAM_CHANNEL_BITS;

    generate
        if (FILTER_TERMS != 0 && FILTER_TERMS != 2 && FILTER_TERMS != 3) begin : g_illegal
            sam_filter_FILTER_TERMS_must_be_0_or_2_or_3 u_error ();
        end
    endgenerate

    reg         valid_q;
    reg [N-1:0] count_q;

    wire         accept  = beat_valid_i & beat_ready_o;
    wire         full    = (count_q == `SAM_FILTER_LIMIT) & ~beat_first_i;
    wire         add     = beat_include_i & ~full;
    wire [N-1:0] so_many = beat_first_i ? {N{1'b0}} : count_q;
    wire [N-1:0] count_d = so_many + {{(N - 1){1'b0}}, add};

    assign beat_ready_o = ~valid_q | pixel_ready_i;

    always @(posedge clk_i) begin
        if (rst_i)             valid_q <= 1'b0;
        else if (beat_ready_o) valid_q <= beat_valid_i & beat_end_i;

        if (accept) count_q <= count_d;
    end

    // Exact division: half of n rides on the sum, one more at n = 2, 4, 6... The only 19-bit
    // reciprocal, 2^18 for n = 1, is replaced by 2^18 - 1, so that a multiplier of 18 bits is
    // enough; the sum must be one higher then, and n = 2 needs no more.
    wire        half;
    wire [17:0] factor;

    generate
        if (FILTER_TERMS == 0) begin : g_reciprocal
            localparam B = `SAM_RECIPROCAL_BITS;
            localparam [32*B-1:0] RECIPROCAL = `SAM_RECIPROCAL;
            // Looked up while the sum is formed, as the multiplication alone fills a clock, and from
            // the count so far, as the next one comes late.
            reg  [17:0] factor_q;
            wire        to_one = beat_first_i | (count_q == 0);

            always @(posedge clk_i) begin
                if (accept & (beat_first_i | add)) begin
                    factor_q <= to_one ? 18'h3ffff : RECIPROCAL[(count_q + 1)*B +: 18];
                end
            end
            assign factor = factor_q;
            assign half   = add & ((so_many == 0) | (so_many[0] & (so_many != 1)));
        end else begin : g_no_reciprocal
            assign factor = 18'd0;
            assign half   = 1'b0;
        end
    endgenerate

    genvar i;
    generate
        for (i = 0; i < CHANNELS; i = i + 1) begin : g_channel
            reg  [12:0] sum_q;
            wire [12:0] so_far = beat_first_i ? 13'd0 : sum_q;
            wire [12:0] more   = add ? {5'd0, beat_rgba_i[8*i +: 8]} : 13'd0;
            // The lowest bit is there to carry `half` into the adder.
            wire [13:0] total  = {so_far, 1'b1} + {more, half};

            always @(posedge clk_i) begin
                if (accept) sum_q <= total[13:1];
            end
            wire unused = &{1'b0, total[0]};

            sam_filter_division #(
                .FILTER_TERMS(FILTER_TERMS)
            ) u_division (
                .sum_i     (sum_q),
                .count_i   (count_q),
                .factor_i  (factor),
                .quotient_o(pixel_rgba_o[8*i +: 8])
            );
        end
    endgenerate

    assign pixel_valid_o = valid_q;
    assign pixel_count_o = count_q;

`ifdef FORMAL
`include "sam_formal.vh"
    `SAM_BEGIN
    // The pixels that are counted, told from the ports: from the first pixel that was opened on, as registers
    // begin with anything.
    reg  f_known = 1'b0;
    wire f_take = beat_valid_i & beat_ready_o;
    wire f_give = pixel_valid_o & pixel_ready_i;
    `SAM_HELD(f_held, f_take & beat_end_i, f_give)
    reg  [5:0] f_count;
    wire [5:0] f_before = beat_first_i ? 0 : f_count;
    wire       f_adds   = beat_include_i & f_before < `SAM_FILTER_LIMIT;
    // The sum holds its rounding already where the division is exact.
    wire [5:0] f_rounding = FILTER_TERMS != 0 | f_count == 0 ? 0 : f_count == 1 ? 1 : f_count / 2;
    reg  [12:0] f_sum [0:CHANNELS-1];
    wire [CHANNELS-1:0] f_good, f_divided;
    wire f_reciprocal;
    // Of the exact division what it divides, as products are hard to compare.
    wire [69:0] f_colour = FILTER_TERMS == 0 ? {factor, f_sums} : pixel_rgba_o;
    wire [51:0] f_sums;

    always @(posedge clk_i) begin
        f_known <= f_known | (f_take & beat_first_i);
        if (f_take) f_count <= f_before + f_adds;
    end

    genvar f_i;
    generate
        for (f_i = 0; f_i < CHANNELS; f_i = f_i + 1) begin : g_f_channel
            assign f_sums[13*f_i +: 13] = g_channel[f_i].sum_q;
            assign f_good[f_i] = g_channel[f_i].sum_q == f_sum[f_i] + f_rounding;
            wire [7:0] f_quotient;
            sam_filter_division #(
                .FILTER_TERMS(FILTER_TERMS)
            ) u_f_division (
                .sum_i     (g_channel[f_i].sum_q),
                .count_i   (count_q),
                .factor_i  (factor),
                .quotient_o(f_quotient)
            );
            assign f_divided[f_i] = pixel_rgba_o[8*f_i +: 8] == f_quotient;
            always @(posedge clk_i) if (f_take) begin
                f_sum[f_i] <= (beat_first_i ? 0 : f_sum[f_i]) + (f_adds ? beat_rgba_i[8*f_i +: 8] : 0);
            end
        end
        if (FILTER_TERMS == 0) begin : g_f_reciprocal
            localparam [32*`SAM_RECIPROCAL_BITS-1:0] F_TABLE = `SAM_RECIPROCAL;
            assign f_reciprocal = f_count == 0 | factor
                == (f_count == 1 ? 18'h3ffff : F_TABLE[f_count * `SAM_RECIPROCAL_BITS +: 18]);
        end else begin : g_f_none
            assign f_reciprocal = 1'b1;
        end
    endgenerate

    always @(posedge clk_i) if (f_begun) begin
        // A pixel that waits is offered again, unchanged.
        p_stable: assert (`SAM_WAITS(pixel_valid_o, pixel_ready_i, {f_colour, pixel_count_o}));
        // No beat is taken while a pixel waits.
        p_nothing_lost: assert (~(f_take & f_held & ~f_give));
        // A pixel is offered exactly when one has ended.
        p_nothing_twice: assert (pixel_valid_o == f_held);
        // From the first opened pixel on the count stays in 0 to 29.
        p_range: assert (~f_known | pixel_count_o <= `SAM_FILTER_LIMIT);
        // It is that of the included beats, of which 29 count.
        p_count: assert (~f_known | pixel_count_o == f_count);
        // Without any the pixel is black and transparent.
        p_empty: assert (~f_known | ~f_held | f_count != 0 | pixel_rgba_o == 0);
        // The sums of all channels are what is divided, the reciprocal is that of the count,
        p_sums: assert (~f_known | (&f_good & f_reciprocal));
        // and each channel of the pixel is what the division gives of its own sum and the count.
        p_divided: assert (&f_divided);
        // Lemma: the sum of nothing is nothing.
        lemma: assert (~f_known | f_count != 0 | {f_sum[0], f_sum[1], f_sum[2], f_sum[3]} == 0);
    end
`endif
endmodule

`default_nettype wire
