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

    wire [X-1:0] from  = is_row ? saved_q : acc_q;
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

        if (accept) begin
            op_q   <= beat_op_i;
            save_q <= beat_save_i;
            last_q <= beat_last_i;
            move_q <= moves & ~is_load;
            acc_q  <= acc_d;
            if (beat_save_i) saved_q <= acc_d;
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
    // 2 frac < 1/2 + G1 at twice the scale: always so in the left half of the pixel, and in the
    // right half when twice the distance from the centre is below G1.
    assign pixel_near_o = ~acc_q[F-1] | ({1'b0, acc_q[F-2:0], 1'b0} < step_q);
endmodule

`default_nettype wire
