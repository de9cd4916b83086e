// Point sampling: of the primary pixels that fall in one secondary pixel, the data of the one
// nearest its centre.
//
// Latency: one clock from the pixel's last beat.
// Reset: rst_i clears valid_q; the candidate is forgotten at the first beat of a pixel anyway.
// Paper: section 5.6.
`include "sam_formats.vh"
`default_nettype none

module sam_sampler #(
    // Bits of data: 1 or more.
    parameter WIDTH = 32
) (
    input  wire             clk_i,
    input  wire             rst_i,

    input  wire             beat_valid_i,
    output wire             beat_ready_o,
    input  wire             beat_first_i,
    input  wire             beat_end_i,
    input  wire             beat_near_i,
    input  wire             beat_take_i,
    input  wire [WIDTH-1:0] beat_data_i,

    output wire             sample_valid_o,
    input  wire             sample_ready_i,
    output wire [WIDTH-1:0] sample_data_o,
    output wire             sample_hit_o
);
    generate
        if (WIDTH < 1) begin : g_illegal
            sam_sampler_WIDTH_must_be_1_or_more u_error ();
        end
    endgenerate

    reg             valid_q;
    reg             hit_q;
    reg [WIDTH-1:0] data_q;

    wire accept  = beat_valid_i & beat_ready_o;
    wire hit     = hit_q & ~beat_first_i;
    wire replace = beat_take_i & (~hit | beat_near_i);

    assign beat_ready_o = ~valid_q | sample_ready_i;

    always @(posedge clk_i) begin
        if (rst_i)             valid_q <= 1'b0;
        else if (beat_ready_o) valid_q <= beat_valid_i & beat_end_i;

        if (accept) begin
            hit_q <= hit | beat_take_i;
            if (replace)  data_q <= beat_data_i;
            else if (~hit) data_q <= {WIDTH{1'b0}};
        end
    end

    assign sample_valid_o = valid_q;
    assign sample_data_o  = data_q;
    assign sample_hit_o   = hit_q;

`ifdef FORMAL
`include "sam_formal.vh"
    `SAM_BEGIN
    // What has been seen of the secondary pixel, told from the ports.
    wire f_take = beat_valid_i & beat_ready_o;
    wire f_give = sample_valid_o & sample_ready_i;
    `SAM_HELD(f_held, f_take & beat_end_i, f_give)
    wire f_any      = ~beat_first_i & f_hit;
    wire f_is_best  = beat_take_i & (beat_near_i | ~f_any);
    reg             f_hit;
    reg [WIDTH-1:0] f_data;

    always @(posedge clk_i) begin
        if (f_take) begin
            f_hit <= f_any | beat_take_i;
            if (f_is_best | ~f_any) f_data <= f_is_best ? beat_data_i : {WIDTH{1'b0}};
        end
        assume (`SAM_WAITS(beat_valid_i, beat_ready_o,
                           {beat_first_i, beat_end_i, beat_near_i, beat_take_i, beat_data_i}));
    end
    always @* assume (f_begun | {hit_q, data_q} == {f_hit, f_data});

    always @(posedge clk_i) if (f_begun) begin
        // A sample that waits is offered again, unchanged.
        p_stable: assert (`SAM_WAITS(sample_valid_o, sample_ready_i, {sample_data_o, sample_hit_o}));
        // No beat is taken while a sample waits.
        p_nothing_lost: assert (~(f_take & f_held & ~f_give));
        // A sample is offered exactly when a pixel has ended.
        p_nothing_twice: assert (sample_valid_o == f_held);
        // There is a sample exactly when the pixel had a beat to take.
        p_hit: assert (~f_held | sample_hit_o == f_hit);
        // It is that of the last near one, or else of the first; 0 where there is none.
        p_data: assert (~f_held | sample_data_o == f_data);
        // Lemma: between the ends too.
        lemma: assert ({hit_q, data_q} == {f_hit, f_data});
    end
`endif
endmodule

`default_nettype wire
