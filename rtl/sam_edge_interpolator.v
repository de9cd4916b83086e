// Linear function on the secondary's whole pixels: an edge function, or a plane of depth or
// colour. Exact, because it only ever moves by whole pixels.
//
// Latency: one clock.
// Reset: rst_i clears valid_q; the accumulator and its increments keep what they had.
// Paper: section 5.3; section 5.5 for the planes.
`include "sam_formats.vh"
`default_nettype none

module sam_edge_interpolator #(
    // Bits of the value: 3 to 64.
    parameter BITS = 34,
    // Bits of the increments for one pixel: 2 to BITS.
    parameter SLOPE_BITS = 22,
    // The secondary's y moves within a row too: 0 or 1.
    parameter TILT = 0
) (
    input  wire                      clk_i,
    input  wire                      rst_i,

    input  wire                      beat_valid_i,
    output wire                      beat_ready_o,
    input  wire [`SAM_OP_BITS-1:0]   beat_op_i,
    input  wire                      beat_save_i,
    input  wire                      beat_move_i,
    input  wire [`SAM_MOVE_BITS-1:0] beat_y_move_i,
    input  wire [BITS-1:0]           beat_start_i,
    input  wire [SLOPE_BITS-1:0]     beat_a_i,
    input  wire [SLOPE_BITS-1:0]     beat_b_i,
    input  wire [BITS-1:0]           beat_row_i,
    input  wire [`SAM_LOW_BITS-1:0]  beat_low_i,

    output wire                      value_valid_o,
    input  wire                      value_ready_i,
    output wire [BITS-1:0]           value_value_o,
    output wire [SLOPE_BITS-1:0]     value_a_o,
    output wire [SLOPE_BITS-1:0]     value_b_o,
    output wire [`SAM_LOW_BITS-1:0]  value_low_o
);
    // Copies of the slope's highest bit that extend the other ones to BITS.
    localparam SIGNS = BITS - SLOPE_BITS + 1;

    generate
        if (BITS < 3 || BITS > 64) begin : g_illegal_bits
            sam_edge_interpolator_BITS_must_be_3_to_64 u_error ();
        end
        if (SLOPE_BITS < 2 || SLOPE_BITS > BITS) begin : g_illegal_slope_bits
            sam_edge_interpolator_SLOPE_BITS_must_be_2_to_BITS u_error ();
        end
        if (TILT != 0 && TILT != 1) begin : g_illegal_tilt
            sam_edge_interpolator_TILT_must_be_0_or_1 u_error ();
        end
    endgenerate

    reg                     valid_q;
    reg [BITS-1:0]          value_q;
    reg [BITS-1:0]          saved_q;
    reg [BITS-1:0]          row_q;
    reg [BITS-1:0]          row_a_q;
    reg [SLOPE_BITS-1:0]    a_q;
    reg [SLOPE_BITS-1:0]    b_q;
    reg [`SAM_LOW_BITS-1:0] low_q;

    wire is_load = beat_op_i == `SAM_OP_LOAD;
    wire accept  = beat_valid_i & beat_ready_o;

    // Kept as they are, or synthesis folds them into the adder's operands and lengthens its path.
    (* keep *) wire is_row;
    (* keep *) wire moves;
    assign is_row = beat_op_i == `SAM_OP_ROW;
    assign moves  = beat_move_i & ~is_load;

    // A ROW that moves adds row + a: summed at LOAD, so that every beat adds two numbers, not three.
    // A LOAD adds nothing to its start, which leaves no choice to be made behind the adder.
    wire [BITS-1:0] load_a = {{SIGNS{beat_a_i[SLOPE_BITS-1]}}, beat_a_i[SLOPE_BITS-2:0]};
    wire [BITS-1:0] a      = {{SIGNS{a_q[SLOPE_BITS-1]}}, a_q[SLOPE_BITS-2:0]};
    wire [BITS-1:0] from   = is_load ? beat_start_i : is_row ? saved_q : value_q;
    wire [BITS-1:0] by     = is_row ? (moves ? row_a_q : row_q) : moves ? a : {BITS{1'b0}};
    wire [BITS-1:0] value_d;

    generate
        if (TILT == 0) begin : g_upright
            assign value_d = from + by;
            wire unused = &{1'b0, beat_y_move_i};
        end else begin : g_tilt
            // y_move * b, a negative one as complement and carry.
            wire [BITS-1:0] b     = {{SIGNS{b_q[SLOPE_BITS-1]}}, b_q[SLOPE_BITS-2:0]};
            wire            minus = beat_y_move_i[1] & ~is_load;
            wire            once  = beat_y_move_i[0] & ~is_load;
            wire [BITS-1:0] size  = once ? b : minus ? {b[BITS-2:0], 1'b0} : {BITS{1'b0}};
            assign value_d = from + by + (size ^ {BITS{minus}}) + {{(BITS - 1){1'b0}}, minus};
        end
    endgenerate

    assign beat_ready_o = ~valid_q | value_ready_i;

    always @(posedge clk_i) begin
        if (rst_i)             valid_q <= 1'b0;
        else if (beat_ready_o) valid_q <= beat_valid_i;

        if (accept) begin
            value_q <= value_d;
            if (beat_save_i) saved_q <= value_d;
            if (is_load) begin
                a_q     <= beat_a_i;
                b_q     <= beat_b_i;
                low_q   <= beat_low_i;
                row_q   <= beat_row_i;
                row_a_q <= beat_row_i + load_a;
            end
        end
    end

    assign value_valid_o = valid_q;
    assign value_value_o = value_q;
    assign value_a_o     = a_q;
    assign value_b_o     = b_q;
    assign value_low_o   = low_q;
endmodule

`default_nettype wire
