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
    reg                     save_q;
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
    // The row start is saved a clock late, from the value: so it depends on no `ready`. Until then the
    // value is it.
    wire            back   = is_row & ~save_q;
    wire [BITS-1:0] from   = is_load ? beat_start_i : back ? saved_q : value_q;
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

        if (save_q) saved_q <= value_q;

        if (accept) begin
            value_q <= value_d;
            save_q  <= beat_save_i;
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

`ifdef FORMAL
`include "sam_formal.vh"
    `SAM_BEGIN
    // The beat inside, the secondary pixel it is on counted from the LOAD, and its value, told from
    // the ports. A row increment is that of a whole movement: row = f_row_x a + f_row_y b.
    wire f_take = beat_valid_i & beat_ready_o;
    wire f_give = value_valid_o & value_ready_i;
    `SAM_HELD(f_held, f_take, f_give)
    wire is_step = ~is_load & ~is_row;
    wire signed [BITS-1:0] f_a_in = $signed(beat_a_i), f_b_in = $signed(beat_b_i);
    wire signed [BITS-1:0] f_move_y = TILT == 1 ? $signed(beat_y_move_i) : 0;
    reg  signed [BITS-1:0] f_a, f_b;
    reg  [BITS-1:0] f_value, f_saved, f_row;
    reg  [`SAM_LOW_BITS-1:0] f_low;
    wire [BITS-1:0] f_moved_a = beat_move_i ? f_a : 0;
    wire [BITS-1:0] f_moved_b = f_move_y == -2 ? -f_b - f_b : f_move_y == -1 ? -f_b : f_move_y == 1 ? f_b : 0;
    wire [BITS-1:0] f_next = is_load ? beat_start_i : (is_row ? f_saved + f_row : f_value) + f_moved_a + f_moved_b;

    always @(posedge clk_i) begin
        if (f_take) begin
            f_value <= f_next;
            if (beat_save_i) f_saved <= f_next;
            if (is_load) {f_a, f_b, f_row, f_low} <= {f_a_in, f_b_in, beat_row_i, beat_low_i};
        end
        assume (`SAM_WAITS(beat_valid_i, beat_ready_o, {beat_op_i, beat_save_i, beat_move_i, beat_y_move_i,
                           beat_start_i, beat_a_i, beat_b_i, beat_row_i, beat_low_i}));
    end
    wire f_same = {value_q, save_q ? value_q : saved_q, row_q, row_a_q, low_q} == {f_value, f_saved, f_row, f_row + f_a, f_low}
                & $signed(a_q) == f_a & $signed(b_q) == f_b;
    always @* assume (f_begun | f_same);

    always @(posedge clk_i) if (f_begun) begin
        // A value that waits is offered again, unchanged.
        p_stable: assert (`SAM_WAITS(value_valid_o, value_ready_i, {value_value_o, value_a_o, value_b_o, value_low_o}));
        // No beat is taken before the one inside has left.
        p_nothing_lost: assert (~(f_take & f_held & ~f_give));
        // A value is offered exactly when a beat is inside.
        p_nothing_twice: assert (value_valid_o == f_held);
        // The value is start, moved by a and b for every pixel that the secondary has moved.
        p_value: assert (~f_held | value_value_o == f_value);
        // Slopes and low bits are those of the last LOAD.
        p_slopes: assert (~f_held | ($signed(value_a_o) == f_a & $signed(value_b_o) == f_b & value_low_o == f_low));
        // Lemma: registers are what the ports tell.
        lemma: assert (f_same);
    end

    // Of narrow values the products can be proved as well: x and y of the pixel counted from the
    // LOAD, and the products kept as sums.
    generate
        if (BITS <= 8) begin : g_plane
            reg  [BITS-1:0] f_c, f_x, f_y, f_saved_x, f_saved_y, f_row_x, f_row_y;
            reg  [BITS-1:0] f_ax, f_by, f_saved_ax, f_saved_by, f_row_ax, f_row_by;
            wire [BITS-1:0] f_any_x = $anyseq;
            wire [BITS-1:0] f_any_y = $anyseq;
            wire [BITS-1:0] f_next_x = is_load ? 0 : (is_row ? f_saved_x + f_row_x : f_x) + beat_move_i;
            wire [BITS-1:0] f_next_y = is_load ? 0 : (is_row ? f_saved_y + f_row_y : f_y) + f_move_y;
            wire [BITS-1:0] f_next_ax = is_load ? 0 : (is_row ? f_saved_ax + f_row_ax : f_ax) + f_moved_a;
            wire [BITS-1:0] f_next_by = is_load ? 0 : (is_row ? f_saved_by + f_row_by : f_by) + f_moved_b;
            always @(posedge clk_i) begin
                if (f_take) begin
                    {f_x, f_y, f_ax, f_by} <= {f_next_x, f_next_y, f_next_ax, f_next_by};
                    if (beat_save_i) {f_saved_x, f_saved_y, f_saved_ax, f_saved_by}
                        <= {f_next_x, f_next_y, f_next_ax, f_next_by};
                    if (is_load) {f_c, f_row_x, f_row_y, f_row_ax, f_row_by}
                        <= {beat_start_i, f_any_x, f_any_y, f_any_x * f_a_in, f_any_y * f_b_in};
                end
                // A polygon begins with a row start; a row's increment is that of a whole movement.
                assume (~f_take | ~is_load | (beat_save_i & beat_row_i == f_any_x * f_a_in + f_any_y * f_b_in));
            end
            wire f_sums = {f_value, f_saved, f_row}
                       == {f_c + f_ax + f_by, f_c + f_saved_ax + f_saved_by, f_row_ax + f_row_by};
            wire f_products = {f_ax, f_saved_ax, f_row_ax} == {f_a * f_x, f_a * f_saved_x, f_a * f_row_x}
                            & {f_by, f_saved_by, f_row_by} == {f_b * f_y, f_b * f_saved_y, f_b * f_row_y};
            always @* assume (f_begun | (f_sums & f_products));
            always @(posedge clk_i) if (f_begun) begin
                // The value is A x + B y + C at the pixel (proved of values of 3 bits).
                p_plane: assert (~f_held | value_value_o == f_c + f_a * f_x + f_b * f_y);
                // Lemma: so is the row start, and its increment.
                lemma_sums: assert (f_sums);
                lemma_products: assert (f_products);
            end
        end
    endgenerate
`endif
endmodule

`default_nettype wire
