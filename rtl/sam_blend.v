// Blending of a secondary pixel with its background: C = S t + (1 - t) B, with t from alpha and
// from the covered area.
//
// Latency: two clocks: the difference S - B and t, then their product. The sum with B follows.
// Reset: rst_i clears the valids of the two stages only.
// Paper: section 5.7, equation 2.
`include "sam_formats.vh"
`default_nettype none

module sam_blend #(
    // 16 coverage samples a pixel: 0 or 1.
    parameter ANTIALIAS = 0,
    // Bits that accompany a pixel unchanged: 1 or more.
    parameter TAG_BITS = 1
) (
    input  wire                                 clk_i,
    input  wire                                 rst_i,

    input  wire                                 pixel_valid_i,
    output wire                                 pixel_ready_o,
    input  wire [`SAM_RGB_BITS-1:0]             pixel_rgb_i,
    input  wire [`SAM_CHANNEL_BITS-1:0]         pixel_alpha_i,
    input  wire [`SAM_AREA_BITS(ANTIALIAS)-1:0] pixel_area_i,
    input  wire [`SAM_RGB_BITS-1:0]             pixel_background_i,
    input  wire [TAG_BITS-1:0]                  pixel_tag_i,

    output wire                                 colour_valid_o,
    input  wire                                 colour_ready_i,
    output wire [`SAM_RGB_BITS-1:0]             colour_rgb_o,
    output wire [TAG_BITS-1:0]                  colour_tag_o
);
    localparam CHANNELS = `SAM_RGB_BITS / `SAM_CHANNEL_BITS;

    generate
        if (ANTIALIAS != 0 && ANTIALIAS != 1) begin : g_illegal_antialias
            sam_blend_ANTIALIAS_must_be_0_or_1 u_error ();
        end
        if (TAG_BITS < 1) begin : g_illegal_tag_bits
            sam_blend_TAG_BITS_must_be_1_or_more u_error ();
        end
    endgenerate

    reg                     factor_valid_q;
    reg [8:0]               factor_q;
    reg [`SAM_RGB_BITS-1:0] factor_background_q;
    reg [TAG_BITS-1:0]      factor_tag_q;
    reg                     colour_valid_q;
    reg [`SAM_RGB_BITS-1:0] colour_background_q;
    reg [TAG_BITS-1:0]      colour_tag_q;

    // 255 must become 256, so that an opaque pixel replaces the background exactly.
    wire [8:0] alpha = {1'b0, pixel_alpha_i} + {8'd0, pixel_alpha_i[7]};
    wire [8:0] factor;

    generate
        if (ANTIALIAS == 0) begin : g_whole
            assign factor = pixel_area_i[0] ? alpha : 9'd0;
        end else begin : g_samples
            wire [13:0] product = {5'd0, alpha} * {9'd0, pixel_area_i} + 14'd8;
            assign factor = product[12:4];
            wire unused = &{1'b0, product[13], product[3:0]};
        end
    endgenerate

    wire colour_free = ~colour_valid_q | colour_ready_i;

    assign pixel_ready_o = ~factor_valid_q | colour_free;

    always @(posedge clk_i) begin
        if (rst_i) begin
            factor_valid_q <= 1'b0;
            colour_valid_q <= 1'b0;
        end else begin
            if (pixel_ready_o) factor_valid_q <= pixel_valid_i;
            if (colour_free)   colour_valid_q <= factor_valid_q;
        end

        if (pixel_valid_i & pixel_ready_o) begin
            factor_q            <= factor;
            factor_background_q <= pixel_background_i;
            factor_tag_q        <= pixel_tag_i;
        end
        if (factor_valid_q & colour_free) begin
            colour_background_q <= factor_background_q;
            colour_tag_q        <= factor_tag_q;
        end
    end

    genvar i;
    generate
        for (i = 0; i < CHANNELS; i = i + 1) begin : g_channel
            // S - B, nine bits signed.
            reg  signed [8:0]  difference_q;
            wire signed [9:0]  weight  = {1'b0, factor_q};
            wire signed [18:0] product = difference_q * weight;
            // The product in whole steps, and one bit for the rounding: it is the carry into the
            // sum, which fits a channel, so that higher bits do not matter.
            reg  [8:0] change_q;
            wire [8:0] sum = {colour_background_q[8*i +: 8], 1'b1} + change_q;

            always @(posedge clk_i) begin
                if (pixel_valid_i & pixel_ready_o) begin
                    difference_q <= {1'b0, pixel_rgb_i[8*i +: 8]} - {1'b0, pixel_background_i[8*i +: 8]};
                end
                if (factor_valid_q & colour_free) change_q <= product[15:7];
            end

            assign colour_rgb_o[8*i +: 8] = sum[8:1];

            wire unused = &{1'b0, product[18:16], product[6:0], sum[0]};
        end
    endgenerate

    assign colour_valid_o = colour_valid_q;
    assign colour_tag_o   = colour_tag_q;

`ifdef FORMAL
`include "sam_formal.vh"
    `SAM_BEGIN
    // The pixels inside, at most two, told from the ports: where the oldest is, and its numbers.
    localparam AB = `SAM_AREA_BITS(ANTIALIAS);
    localparam FB = 2 * `SAM_RGB_BITS + 8 + AB + TAG_BITS;
    wire f_take = pixel_valid_i & pixel_ready_o;
    wire f_give = colour_valid_o & colour_ready_i;
    wire [FB-1:0] f_new = {pixel_rgb_i, pixel_background_i, pixel_alpha_i, pixel_area_i, pixel_tag_i};
    reg  [1:0]    f_inside;
    reg  [FB-1:0] f_first, f_second;
    wire [1:0]    f_left = f_inside - f_give;
    wire [`SAM_RGB_BITS-1:0] f_rgb, f_background;
    wire [7:0]          f_alpha;
    wire [AB-1:0]       f_area;
    wire [TAG_BITS-1:0] f_tag;
    assign {f_rgb, f_background, f_alpha, f_area, f_tag} = f_first;

    always @(posedge clk_i) begin
        f_inside <= rst_i ? 0 : f_left + f_take;
        if (f_give) f_first <= f_second;
        if (f_take & f_left == 0) f_first  <= f_new;
        if (f_take & f_left == 1) f_second <= f_new;
        assume (`SAM_WAITS(pixel_valid_i, pixel_ready_o, f_new));
        assume (~pixel_valid_i | pixel_area_i <= `SAM_FULL_AREA(ANTIALIAS));
    end

    // What the registers hold of them.
    wire [FB-1:0] f_in_factor = colour_valid_q ? f_second : f_first;
    wire [`SAM_RGB_BITS-1:0] f_factor_rgb, f_factor_background;
    wire [7:0]          f_factor_alpha;
    wire [AB-1:0]       f_factor_area;
    wire [TAG_BITS-1:0] f_factor_tag;
    assign {f_factor_rgb, f_factor_background, f_factor_alpha, f_factor_area, f_factor_tag} = f_in_factor;
    wire [8:0]  f_factor_whole = f_factor_alpha + f_factor_alpha[7];
    wire [13:0] f_factor_part  = f_factor_whole * f_factor_area + 8;
    wire [8:0]  f_factor = ANTIALIAS == 1 ? f_factor_part >> 4 : f_factor_area != 0 ? f_factor_whole : 0;
    wire [CHANNELS-1:0] f_differences;
    genvar f_i;
    generate
        for (f_i = 0; f_i < CHANNELS; f_i = f_i + 1) begin : g_f
            assign f_differences[f_i] = g_channel[f_i].difference_q
                == {1'b0, f_factor_rgb[8*f_i +: 8]} - {1'b0, f_factor_background[8*f_i +: 8]};
        end
    endgenerate

    // One channel, whichever: colour, background and what comes out.
    wire [1:0] f_channel = $anyconst;
    wire [7:0] f_s = f_rgb >> 8 * f_channel, f_b = f_background >> 8 * f_channel;
    wire [7:0] f_c = colour_rgb_o >> 8 * f_channel;
    always @* assume (f_channel < CHANNELS);

    always @(posedge clk_i) if (f_begun) begin
        // A colour that waits is offered again, unchanged.
        p_stable: assert (`SAM_WAITS(colour_valid_o, colour_ready_i, {colour_rgb_o, colour_tag_o}));
        // Never are there more than two pixels inside.
        p_nothing_lost: assert (f_inside <= 2);
        // No colour is offered without a pixel inside.
        p_nothing_twice: assert (~colour_valid_o | f_inside != 0);
        // A pixel is offered at the latest in the second clock after it was taken.
        p_prompt: assert ($past(~f_begun | rst_i | f_inside == 0 | f_give, 1) | colour_valid_o);
        // It comes with its tag, in order.
        p_tag: assert (~colour_valid_o | colour_tag_o == f_tag);
        // Alpha 0 leaves the background.
        p_transparent: assert (~colour_valid_o | f_alpha != 0 | f_c == f_b);
        // So does a pixel of which nothing is covered.
        p_uncovered: assert (~colour_valid_o | f_area != 0 | f_c == f_b);
        // Alpha 255 of a whole pixel gives the colour.
        p_opaque: assert (~colour_valid_o | f_alpha != 255 | f_area != `SAM_FULL_AREA(ANTIALIAS) | f_c == f_s);
        // The result lies between the two.
        p_between: assert (~colour_valid_o | (f_s < f_b ? f_s <= f_c & f_c <= f_b : f_b <= f_c & f_c <= f_s));
        // Lemma: registers are what the ports tell.
        lemma: assert (f_inside == factor_valid_q + colour_valid_q
            & (~factor_valid_q | (&f_differences & f_factor_area <= `SAM_FULL_AREA(ANTIALIAS) & factor_q == f_factor & factor_q <= 256
                & {factor_background_q, factor_tag_q} == {f_factor_background, f_factor_tag}))
            & (~colour_valid_q | {colour_background_q, colour_tag_q, f_area <= `SAM_FULL_AREA(ANTIALIAS)}
                == {f_background, f_tag, 1'b1}));
    end
`endif
endmodule

`default_nettype wire
