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

`ifdef FORMAL
`include "sam_formal.vh"
    `SAM_BEGIN
    // The beats inside, told from the ports: how many, the first and the second one.
    wire f_take = in_valid_i & in_ready_o;
    wire f_give = out_valid_o & out_ready_i;
    reg  [1:0]       f_inside;
    reg  [WIDTH-1:0] f_first, f_second;
    wire [1:0]       f_left = f_inside - f_give;
    always @(posedge clk_i) begin
        f_inside <= rst_i ? 0 : f_left + f_take;
        if (f_give) f_first <= f_second;
        if (f_take & f_left == 0) f_first  <= in_data_i;
        if (f_take & f_left == 1) f_second <= in_data_i;
    end

    always @(posedge clk_i) if (f_begun) begin
        // A beat that waits is offered again, unchanged.
        p_stable: assert (`SAM_WAITS(out_valid_o, out_ready_i, out_data_o));
        // No beat is taken where two are inside.
        p_nothing_lost: assert (f_inside <= 2);
        // A beat is offered exactly when one is inside,
        p_nothing_twice: assert (out_valid_o == (f_inside != 0));
        // as it was taken, in order.
        p_data: assert (~out_valid_o | out_data_o == f_first);
        // The one behind it is shown as it was taken.
        p_back: assert (back_valid_o == (f_inside == 2) & (~back_valid_o | back_data_o == f_second));
        // There is room unless two are inside.
        p_room: assert (in_ready_o == (f_inside != 2));
        // Lemma: registers are what the ports tell.
        lemma: assert (f_inside == valid_q[0] + valid_q[1] & (write_q ^ read_q) == f_inside[0]
                       & (f_inside == 0 | valid_q[read_q]));
    end
`endif
endmodule

`default_nettype wire
