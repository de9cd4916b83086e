// Two register stages of a pipeline in one: what is behind it never waits for a path from what is
// in front, as `in_ready_o` is a register. What is inside can be seen.
//
// Latency: one clock, or more while the beat in front waits.
// Reset: rst_i clears the two valids only.
`default_nettype none

module sam_buffer #(
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
    output wire [WIDTH-1:0] out_data_o,

    // The beat behind the one that is offered.
    output wire             back_valid_o,
    output wire [WIDTH-1:0] back_data_o
);
    generate
        if (WIDTH < 1) begin : g_illegal
            sam_buffer_WIDTH_must_be_1_or_more u_error ();
        end
    endgenerate

    reg             front_valid_q;
    reg             back_valid_q;
    reg [WIDTH-1:0] front_q;
    reg [WIDTH-1:0] back_q;

    wire front_free = ~front_valid_q | out_ready_i;

    assign in_ready_o   = ~back_valid_q;
    assign out_valid_o  = front_valid_q;
    assign out_data_o   = front_q;
    assign back_valid_o = back_valid_q;
    assign back_data_o  = back_q;

    always @(posedge clk_i) begin
        if (rst_i) begin
            front_valid_q <= 1'b0;
            back_valid_q  <= 1'b0;
        end else begin
            if (front_free) front_valid_q <= back_valid_q | in_valid_i;
            back_valid_q <= ~front_free & (back_valid_q | in_valid_i);
        end

        if (front_free)    front_q <= back_valid_q ? back_q : in_data_i;
        if (~back_valid_q) back_q  <= in_data_i;
    end
endmodule

`default_nettype wire
