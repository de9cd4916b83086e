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
endmodule

`default_nettype wire
