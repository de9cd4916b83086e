// X coordinate interpolator: the secondary x of every primary pixel, how far it moved in whole
// pixels, and whether the beat is the last one in its secondary pixel.
//
// Latency: one clock. A beat leaves when it is the polygon's last one or the next beat is
// offered, because only the next beat shows whether the secondary pixel goes on.
// Reset: rst_i clears valid_q; the accumulator and its increments keep what they had.
// Paper: section 5.1.
`include "sam_formats.vh"
`default_nettype none

module sam_x_interpolator #(
    // Fraction bits of a snapped vertex, sets the integer bits of x: 4 or 8.
    parameter SUBPIXEL_BITS = 8
) (
    input  wire                                           clk_i,
    input  wire                                           rst_i,
    input  wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] width_i,

    input  wire                                           beat_valid_i,
    output wire                                           beat_ready_o,
    input  wire [`SAM_OP_BITS-1:0]                        beat_op_i,
    input  wire                                           beat_save_i,
    input  wire                                           beat_last_i,
    input  wire [`SAM_X_BITS(SUBPIXEL_BITS)-1:0]          beat_start_i,
    input  wire [`SAM_SCALE_BITS-1:0]                     beat_step_i,
    input  wire [`SAM_X_BITS(SUBPIXEL_BITS)-1:0]          beat_row_i,

    output wire                                           pixel_valid_o,
    input  wire                                           pixel_ready_i,
    output wire [`SAM_OP_BITS-1:0]                        pixel_op_o,
    output wire                                           pixel_save_o,
    output wire                                           pixel_last_o,
    output wire [`SAM_PIXEL_X_BITS(SUBPIXEL_BITS)-1:0]    pixel_x_o,
    output wire                                           pixel_move_o,
    output wire                                           pixel_near_o,
    output wire                                           pixel_inside_o,
    output wire                                           pixel_end_o
);
    localparam X = `SAM_X_BITS(SUBPIXEL_BITS);
    localparam F = `SAM_FRACTION_BITS;

    generate
        if (SUBPIXEL_BITS != 4 && SUBPIXEL_BITS != 8) begin : g_illegal
            sam_x_interpolator_SUBPIXEL_BITS_must_be_4_or_8 u_error ();
        end
    endgenerate

    reg                       valid_q;
    reg [`SAM_OP_BITS-1:0]    op_q;
    reg                       save_q;
    reg                       last_q;
    reg                       move_q;
    reg [X-1:0]               acc_q;
    reg [X-1:0]               saved_q;
    reg [X-1:0]               row_q;
    reg [`SAM_SCALE_BITS-1:0] step_q;

    wire is_load = beat_op_i == `SAM_OP_LOAD;
    wire is_row  = beat_op_i == `SAM_OP_ROW;
    wire accept  = beat_valid_i & beat_ready_o;

    // The row start is saved a clock late, from the accumulator: so it depends on no `ready`. Until then
    // the accumulator is it.
    wire         back  = is_row & ~save_q;
    wire [X-1:0] from  = back ? saved_q : acc_q;
    wire [X-1:0] by    = is_row ? row_q : {{(X - `SAM_SCALE_BITS){1'b0}}, step_q};
    wire [X-1:0] sum   = from + by;
    wire [X-1:0] acc_d = is_load ? beat_start_i : sum;

    // The fraction's carry, read back from the first integer bit: a single carry chain serves both.
    wire carry = sum[F] ^ from[F] ^ by[F];
    // A step of exactly 1.0 has no fraction to carry and still moves by a pixel.
    wire moves = carry | (~is_row & step_q[F]);

    assign beat_ready_o  = ~valid_q | pixel_ready_i;
    assign pixel_valid_o = valid_q & (last_q | beat_valid_i);

    always @(posedge clk_i) begin
        if (rst_i) valid_q <= 1'b0;
        else       valid_q <= beat_valid_i | (valid_q & ~(pixel_valid_o & pixel_ready_i));

        if (save_q) saved_q <= acc_q;

        if (accept) begin
            op_q   <= beat_op_i;
            save_q <= beat_save_i;
            last_q <= beat_last_i;
            move_q <= moves & ~is_load;
            acc_q  <= acc_d;
            if (is_load) begin
                step_q <= beat_step_i;
                row_q  <= beat_row_i;
            end
        end
    end

    assign pixel_op_o   = op_q;
    assign pixel_save_o = save_q;
    assign pixel_last_o = last_q;
    assign pixel_move_o = move_q;
    assign pixel_x_o    = acc_q[X-1:F];
    assign pixel_end_o  = last_q | (beat_op_i == `SAM_OP_LOAD) | is_row
                        | (beat_op_i == `SAM_OP_RESERVED) | moves;
    // A negative x is, read as unsigned, larger than any width.
    assign pixel_inside_o = acc_q[X-1:F] < {{(X - F - `SAM_COORDINATE_BITS(SUBPIXEL_BITS)){1'b0}}, width_i};
    // 2 frac < 1 + G1: always so in the left half of the pixel, and in the right half when twice the
    // distance from the centre is below G1.
    assign pixel_near_o = ~acc_q[F-1] | ({1'b0, acc_q[F-2:0], 1'b0} < step_q);

`ifdef FORMAL
`include "sam_formal.vh"
    `SAM_BEGIN
    // The beat inside and its accumulator, told from the ports.
    wire f_take = beat_valid_i & beat_ready_o;
    wire f_give = pixel_valid_o & pixel_ready_i;
    `SAM_HELD(f_held, f_take, f_give)
    reg  [`SAM_OP_BITS-1:0]    f_op;
    reg                        f_save, f_last;
    reg  [X-1:0]               f_acc, f_before, f_saved, f_row;
    reg  [`SAM_SCALE_BITS-1:0] f_step;
    wire [X-1:0] f_next = beat_op_i == `SAM_OP_LOAD ? beat_start_i
                        : beat_op_i == `SAM_OP_ROW ? f_saved + f_row : f_acc + f_step;
    wire [X-F-1:0] f_x      = f_acc >> F;
    wire [X-F-1:0] f_next_x = f_next >> F;
    wire [X-F-1:0] f_moved  = f_x - (f_before >> F) - (f_op == `SAM_OP_ROW ? f_row >> F : 0);

    always @(posedge clk_i) begin
        if (f_take) begin
            {f_op, f_save, f_last} <= {beat_op_i, beat_save_i, beat_last_i};
            f_acc    <= f_next;
            f_before <= beat_op_i == `SAM_OP_ROW ? f_saved : f_acc;
            if (beat_save_i) f_saved <= f_next;
            if (beat_op_i == `SAM_OP_LOAD) {f_step, f_row} <= {beat_step_i, beat_row_i};
        end
        assume (`SAM_WAITS(beat_valid_i, beat_ready_o, {beat_op_i, beat_save_i, beat_last_i,
                           beat_start_i, beat_step_i, beat_row_i}));
        assume (width_i <= `SAM_MAX_SIZE(SUBPIXEL_BITS) & (~f_begun | $stable(width_i)));
    end
    wire f_same = {acc_q, save_q ? acc_q : saved_q, row_q, step_q} == {f_acc, f_saved, f_row, f_step};
    always @* assume (f_begun | f_same);

    always @(posedge clk_i) if (f_begun) begin
        // A pixel that waits is offered again, unchanged.
        p_stable: assert (`SAM_WAITS(pixel_valid_o, pixel_ready_i, {pixel_op_o, pixel_save_o,
            pixel_last_o, pixel_x_o, pixel_move_o, pixel_near_o, pixel_inside_o, pixel_end_o}));
        // No beat is taken before the one inside has left.
        p_nothing_lost: assert (~(f_take & f_held & ~f_give));
        // No pixel is offered without a beat inside.
        p_nothing_twice: assert (~pixel_valid_o | f_held);
        // The beat inside is offered when it is the last one or the next one is there.
        p_nothing_kept: assert (pixel_valid_o | ~f_held | ~(f_last | beat_valid_i));
        // A pixel has the op, save and last of its beat.
        p_labels: assert (~f_held | {pixel_op_o, pixel_save_o, pixel_last_o} == {f_op, f_save, f_last});
        // x is the floor of start, of the sum of the steps, or of row start and row increment.
        p_x: assert (~f_held | pixel_x_o == f_x);
        // A step of at most 1.0 moves by 0 or +1, the difference of the floors.
        p_step_moves: assert (~f_held | f_op != `SAM_OP_STEP | f_step > `SAM_SCALE_ONE | pixel_move_o == f_moved);
        // A row moves by 0 or +1 more than the floor of its increment.
        p_row_moves: assert (~f_held | f_op != `SAM_OP_ROW | pixel_move_o == f_moved);
        // A load does not move.
        p_load_moves: assert (~f_held | f_op != `SAM_OP_LOAD | ~pixel_move_o);
        // A beat is near when twice its fraction is below 1 + G1.
        p_near: assert (~f_held | pixel_near_o == ({f_acc[F-1:0], 1'b0} < f_step + (1 << F)));
        // A pixel is inside where 0 <= x < width.
        p_inside: assert (~f_held | pixel_inside_o == (~f_acc[X-1] & f_x < width_i));
        // The last beat of a secondary pixel ends it: what follows is no step, or one that moves.
        p_ends: assert (~pixel_valid_o | pixel_end_o == (f_last | beat_op_i != `SAM_OP_STEP | f_next_x != f_x));
        // Lemma: registers are what the ports tell.
        lemma: assert (f_same & valid_q == f_held);
    end
`endif
endmodule

`default_nettype wire
