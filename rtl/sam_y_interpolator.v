// Y coordinate interpolator: the display row of every primary pixel, stepped from scan line to
// scan line; with TILT the secondary y is affine in both directions, for a tilted head.
//
// Latency: one clock. Looks one beat ahead like sam_x_interpolator.
// Reset: rst_i clears valid_q; all other registers keep what they had.
// Paper: section 5.2.
`include "sam_formats.vh"
`default_nettype none

module sam_y_interpolator #(
    // Fraction bits of a snapped vertex, sets the width of a coordinate: 4 or 8.
    parameter SUBPIXEL_BITS = 8,
    // Secondary y affine in both directions: 0 or 1.
    parameter TILT = 0
) (
    input  wire                                           clk_i,
    input  wire                                           rst_i,
    input  wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] height_i,

    input  wire                                           beat_valid_i,
    output wire                                           beat_ready_o,
    input  wire [`SAM_OP_BITS-1:0]                        beat_op_i,
    input  wire                                           beat_save_i,
    input  wire                                           beat_last_i,
    input  wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] beat_start_i,
    input  wire [`SAM_DISPLAY_STEP_BITS-1:0]              beat_step_i,
    input  wire [`SAM_X_BITS(SUBPIXEL_BITS)-1:0]          beat_view_i,
    input  wire [`SAM_SLANT_BITS-1:0]                     beat_slant_i,
    input  wire [`SAM_X_BITS(SUBPIXEL_BITS)-1:0]          beat_row_i,

    output wire                                           pixel_valid_o,
    input  wire                                           pixel_ready_i,
    output wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] pixel_y_o,
    output wire [`SAM_MOVE_BITS-1:0]                      pixel_move_o,
    output wire                                           pixel_inside_o,
    output wire                                           pixel_end_o
);
    localparam C = `SAM_COORDINATE_BITS(SUBPIXEL_BITS);
    localparam S = `SAM_DISPLAY_STEP_BITS;

    generate
        if (SUBPIXEL_BITS != 4 && SUBPIXEL_BITS != 8) begin : g_illegal_subpixel_bits
            sam_y_interpolator_SUBPIXEL_BITS_must_be_4_or_8 u_error ();
        end
        if (TILT != 0 && TILT != 1) begin : g_illegal_tilt
            sam_y_interpolator_TILT_must_be_0_or_1 u_error ();
        end
    endgenerate

    reg         valid_q;
    reg         last_q;
    reg [C-1:0] y_q;
    reg [S-1:0] step_q;

    wire is_load = beat_op_i == `SAM_OP_LOAD;
    wire is_row  = beat_op_i == `SAM_OP_ROW;
    wire is_step = beat_op_i == `SAM_OP_STEP;
    wire accept  = beat_valid_i & beat_ready_o;

    assign beat_ready_o  = ~valid_q | pixel_ready_i;
    assign pixel_valid_o = valid_q & (last_q | beat_valid_i);

    always @(posedge clk_i) begin
        if (rst_i) valid_q <= 1'b0;
        else       valid_q <= beat_valid_i | (valid_q & ~(pixel_valid_o & pixel_ready_i));

        if (accept) begin
            last_q <= beat_last_i;
            if (is_load) step_q <= beat_step_i;
        end
    end

    generate
        if (TILT == 0) begin : g_upright
            wire [C-1:0] step_wide = {{(C - S){step_q[S-1]}}, step_q};

            always @(posedge clk_i) begin
                if (accept & is_load)     y_q <= beat_start_i;
                else if (accept & is_row) y_q <= y_q + step_wide;
            end

            assign pixel_y_o      = y_q;
            assign pixel_move_o   = {`SAM_MOVE_BITS{1'b0}};
            assign pixel_inside_o = 1'b1;
            assign pixel_end_o    = last_q | ~is_step;

            wire unused = &{1'b0, height_i, beat_save_i, beat_view_i, beat_slant_i, beat_row_i};
        end else begin : g_tilt
            localparam X = `SAM_X_BITS(SUBPIXEL_BITS);
            localparam F = `SAM_FRACTION_BITS;
            localparam M = `SAM_MOVE_BITS;

            reg [M-1:0]               move_q;
            reg [X-1:0]               view_q;
            reg [X-1:0]               saved_q;
            reg [X-1:0]               row_q;
            reg [`SAM_SLANT_BITS-1:0] slant_q;

            wire [X-1:0] slant_wide = {{(X - `SAM_SLANT_BITS){slant_q[`SAM_SLANT_BITS-1]}}, slant_q};
            wire [X-1:0] from       = is_row ? saved_q : view_q;
            wire [X-1:0] by         = is_row ? row_q : slant_wide;
            wire [X-1:0] sum        = from + by;
            wire [X-1:0] view_d     = is_load ? beat_view_i : sum;

            // Of a row's movement only the carry counts: the rest is in the row increments of the
            // edges. Of a slant the integer bits count too.
            wire [M-1:0] whole = is_row ? {M{1'b0}} : by[F+M-1:F];
            wire [M-1:0] moves = whole + {{(M - 1){1'b0}}, sum[F] ^ from[F] ^ by[F]};

            always @(posedge clk_i) begin
                if (accept) begin
                    move_q <= is_load ? {M{1'b0}} : moves;
                    view_q <= view_d;
                    if (beat_save_i) saved_q <= view_d;
                    if (is_load) begin
                        y_q     <= beat_start_i;
                        row_q   <= beat_row_i;
                        slant_q <= beat_slant_i;
                    end
                end
            end

            // step * v by shifted addends: a multiplier would be mostly empty with a 3-bit step.
            wire [X-F-1:0] v     = view_q[X-1:F];
            wire [C-1:0]   once  = step_q[0] ? v[C-1:0] : {C{1'b0}};
            wire [C-1:0]   twice = step_q[1] ? {v[C-2:0], 1'b0} : {C{1'b0}};
            wire [C-1:0]   minus = step_q[2] ? ~{v[C-3:0], 2'b00} : {C{1'b1}};

            assign pixel_y_o      = y_q + once + twice + minus + {{(C - 1){1'b0}}, 1'b1};
            assign pixel_move_o   = move_q;
            assign pixel_inside_o = v < {{(X - F - C){1'b0}}, height_i};
            assign pixel_end_o    = last_q | ~is_step | (moves != {M{1'b0}});
        end
    endgenerate

`ifdef FORMAL
`include "sam_formal.vh"
    `SAM_BEGIN
    // The beat inside, its y and, with TILT, its accumulator, told from the ports.
    localparam XB = `SAM_X_BITS(SUBPIXEL_BITS);
    localparam FB = `SAM_FRACTION_BITS;
    wire f_take = beat_valid_i & beat_ready_o;
    wire f_give = pixel_valid_o & pixel_ready_i;
    `SAM_HELD(f_held, f_take, f_give)
    reg                              f_last;
    reg [`SAM_OP_BITS-1:0]           f_op;
    reg [C-1:0]                      f_start, f_upright;
    reg signed [S-1:0]               f_step;
    reg [XB-1:0]                     f_view, f_before, f_saved, f_row;
    reg signed [`SAM_SLANT_BITS-1:0] f_slant;
    wire signed [XB-1:0] f_slant_wide = f_slant;
    wire signed [C-1:0]  f_step_wide  = f_step;
    wire [XB-1:0] f_next = beat_op_i == `SAM_OP_LOAD ? beat_view_i
                         : beat_op_i == `SAM_OP_ROW ? f_saved + f_row : f_view + f_slant_wide;
    wire signed [XB-FB-1:0] f_v      = f_view >> FB;
    wire signed [XB-FB-1:0] f_next_v = f_next >> FB;
    wire signed [C-1:0] f_tilted = f_step * f_v;
    wire [XB-FB-1:0] f_moved  = f_v - (f_before >> FB) - (f_op == `SAM_OP_ROW ? f_row >> FB : 0);

    always @(posedge clk_i) begin
        if (f_take) begin
            {f_op, f_last} <= {beat_op_i, beat_last_i};
            f_view   <= f_next;
            f_before <= beat_op_i == `SAM_OP_ROW ? f_saved : f_view;
            if (beat_save_i) f_saved <= f_next;
            f_upright <= beat_op_i == `SAM_OP_LOAD ? beat_start_i
                       : beat_op_i == `SAM_OP_ROW ? f_upright + f_step_wide : f_upright;
            if (beat_op_i == `SAM_OP_LOAD) begin
                {f_start, f_step, f_row, f_slant} <= {beat_start_i, beat_step_i, beat_row_i, beat_slant_i};
            end
        end
        assume (`SAM_WAITS(beat_valid_i, beat_ready_o, {beat_op_i, beat_save_i, beat_last_i,
                           beat_start_i, beat_step_i, beat_view_i, beat_slant_i, beat_row_i}));
        assume (height_i <= `SAM_MAX_SIZE(SUBPIXEL_BITS) & (~f_begun | $stable(height_i)));
    end
    wire f_same;
    generate
        if (TILT == 0) assign f_same = {y_q, step_q} == {f_upright, f_step};
        else assign f_same = {y_q, step_q, g_tilt.view_q, g_tilt.saved_q, g_tilt.row_q, g_tilt.slant_q}
                          == {f_start, f_step, f_view, f_saved, f_row, f_slant};
    endgenerate
    always @* assume (f_begun | f_same);

    always @(posedge clk_i) if (f_begun) begin
        // A pixel that waits is offered again, unchanged.
        p_stable: assert (`SAM_WAITS(pixel_valid_o, pixel_ready_i,
                                   {pixel_y_o, pixel_move_o, pixel_inside_o, pixel_end_o}));
        // No beat is taken before the one inside has left.
        p_nothing_lost: assert (~(f_take & f_held & ~f_give));
        // No pixel is offered without a beat inside.
        p_nothing_twice: assert (~pixel_valid_o | f_held);
        // The beat inside is offered when it is the last one or the next one is there.
        p_nothing_kept: assert (pixel_valid_o | ~f_held | ~(f_last | beat_valid_i));
        // An upright y is start plus one step for every row since; a tilted one is start + step v.
        p_y: assert (~f_held | pixel_y_o == (TILT == 0 ? f_upright : f_start + f_tilted));
        // An upright y never moves within a row.
        p_upright: assert (TILT == 1 | (pixel_move_o == 0 & pixel_inside_o));
        // A tilted step moves by the difference of the floors of v, -1, 0 or 1 where the slant is below 1.
        p_step_moves: assert (TILT == 0 | ~f_held | f_op != `SAM_OP_STEP | $signed(pixel_move_o) == $signed(f_moved)
                            | f_slant >= (1 << FB) | f_slant < -(1 << FB));
        // A tilted row moves by 0 or +1 more than the floor of its increment, a load not at all.
        p_row_moves: assert (TILT == 0 | ~f_held | (f_op != `SAM_OP_ROW & f_op != `SAM_OP_LOAD)
                           | pixel_move_o == (f_op == `SAM_OP_LOAD ? 0 : f_moved[1:0]));
        // A tilted pixel is inside where 0 <= v < height.
        p_inside: assert (TILT == 0 | ~f_held | pixel_inside_o == (~f_view[XB-1] & $unsigned(f_v) < height_i));
        // The last beat of a secondary pixel ends it: what follows is no step, or one that changes v.
        p_ends: assert (~pixel_valid_o | (TILT == 1 & (f_slant >= (1 << FB) | f_slant < -(1 << FB)))
                      | pixel_end_o == (f_last | beat_op_i != `SAM_OP_STEP | (TILT == 1 & f_next_v != f_v)));
        // Lemma: registers are what the ports tell.
        lemma: assert (f_same & valid_q == f_held & (~f_held | last_q == f_last));
    end
`endif
endmodule

`default_nettype wire
