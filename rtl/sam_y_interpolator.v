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
endmodule

`default_nettype wire
