// Room for two beats between stages of a pipeline: `in_ready_o` follows from registers, and so does what
// the payload's registers take. What is inside can be seen.
//
// Latency: one clock, or more while the beat in front waits.
// Reset: rst_i empties it; the payload keeps what it had.
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

    reg             write_q;
    reg             read_q;
    reg [1:0]       valid_q;
    reg [WIDTH-1:0] data0_q;
    reg [WIDTH-1:0] data1_q;

    wire write = in_valid_i & in_ready_o;
    wire read  = out_valid_o & out_ready_i;

    assign in_ready_o   = ~(valid_q[0] & valid_q[1]);
    assign out_valid_o  = valid_q[0] | valid_q[1];
    assign out_data_o   = read_q ? data1_q : data0_q;
    assign back_valid_o = valid_q[0] & valid_q[1];
    assign back_data_o  = read_q ? data0_q : data1_q;

    always @(posedge clk_i) begin
        if (rst_i) begin
            write_q <= 1'b0;
            read_q  <= 1'b0;
            valid_q <= 2'b00;
        end else begin
            write_q    <= write_q ^ write;
            read_q     <= read_q ^ read;
            valid_q[0] <= (valid_q[0] & ~(read & ~read_q)) | (write & ~write_q);
            valid_q[1] <= (valid_q[1] & ~(read & read_q)) | (write & write_q);
        end

        // Neither looks at a valid or a ready from outside, which may come late and far.
        if (~valid_q[0]) data0_q <= in_data_i;
        if (~valid_q[1]) data1_q <= in_data_i;
    end
endmodule

`default_nettype wire
