// One register stage of a pipeline, with the handshake of a stream.
//
// Latency: one clock.
// Reset: rst_i clears valid_q only.
`default_nettype none

module sam_stage #(
    // Bits of payload: 1 or more.
    parameter WIDTH = 1
) (
    input  wire             clk_i,
    input  wire             rst_i,

    input  wire             in_valid_i,
    output wire             in_ready_o,
    input  wire [WIDTH-1:0] in_data_i,

    output wire             out_valid_o,
    input  wire             out_ready_i,
    output wire [WIDTH-1:0] out_data_o
);
    generate
        if (WIDTH < 1) begin : g_illegal
            sam_stage_WIDTH_must_be_1_or_more u_error ();
        end
    endgenerate

    reg             valid_q;
    reg [WIDTH-1:0] data_q;

    assign in_ready_o  = ~valid_q | out_ready_i;
    assign out_valid_o = valid_q;
    assign out_data_o  = data_q;

    always @(posedge clk_i) begin
        if (rst_i)           valid_q <= 1'b0;
        else if (in_ready_o) valid_q <= in_valid_i;

        // Without a look at the valid, which may come late.
        if (in_ready_o) data_q <= in_data_i;
    end
endmodule

`default_nettype wire
