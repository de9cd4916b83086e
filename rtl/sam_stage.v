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

`ifdef FORMAL
`include "sam_formal.vh"
    `SAM_BEGIN
    wire f_take = in_valid_i & in_ready_o;
    wire f_give = out_valid_o & out_ready_i;
    `SAM_HELD(f_held, f_take, f_give)
    reg [WIDTH-1:0] f_data;
    always @(posedge clk_i) if (f_take) f_data <= in_data_i;

    always @(posedge clk_i) if (f_begun) begin
        // A beat that waits is offered again, unchanged.
        p_stable: assert (`SAM_WAITS(out_valid_o, out_ready_i, out_data_o));
        // No beat is taken before the one inside has left.
        p_nothing_lost: assert (~(f_take & f_held & ~f_give));
        // A beat is offered exactly when one is inside.
        p_nothing_twice: assert (out_valid_o == f_held);
        // It is offered as it was taken.
        p_data: assert (~f_held | out_data_o == f_data);
        // There is room for a beat in every clock in which the one inside leaves.
        p_room: assert (in_ready_o | (f_held & ~out_ready_i));
    end
`endif
endmodule

`default_nettype wire
