// Depth, colour and alpha of the primary pipeline's pixels: planes stepped from pixel to pixel, clamped
// to the ranges of a pixel.
//
// Latency: one clock.
// Reset: as sam_edge_interpolator.
// Paper: section 3.
`include "sam_formats.vh"
`default_nettype none

module sam_primary_planes (
    input  wire                                clk_i, rst_i,

    input  wire                                beat_valid_i,
    input  wire [`SAM_OP_BITS-1:0]             beat_op_i,
    input  wire                                beat_save_i, beat_move_i,
    input  wire [`SAM_DEPTH_PLANE_BITS-1:0]    z_start_i, z_a_i, z_row_i,
    input  wire [`SAM_COLOUR_PLANE_BITS-1:0]   red_start_i, red_a_i, red_row_i,
    input  wire [`SAM_COLOUR_PLANE_BITS-1:0]   green_start_i, green_a_i, green_row_i,
    input  wire [`SAM_COLOUR_PLANE_BITS-1:0]   blue_start_i, blue_a_i, blue_row_i,
    input  wire [`SAM_COLOUR_PLANE_BITS-1:0]   alpha_start_i, alpha_a_i, alpha_row_i,

    input  wire                                value_ready_i,
    output wire [`SAM_DEPTH_BITS-1:0]          depth_o,
    output wire [`SAM_RGBA_BITS-1:0]           rgba_o
);
    localparam Z = `SAM_DEPTH_PLANE_BITS;
    localparam K = `SAM_COLOUR_PLANE_BITS;
    localparam L = `SAM_LOW_BITS;
    localparam M = `SAM_CHANNEL_BITS;

    wire [Z-1:0] depth, depth_a, depth_b;
    wire [K-1:0] red, red_a, red_b, green, green_a, green_b, blue, blue_a, blue_b, alpha, alpha_a, alpha_b;
    wire [L-1:0] depth_low, red_low, green_low, blue_low, alpha_low;
    wire [4:0]   ready, valid;

    sam_edge_interpolator #(.BITS(Z), .SLOPE_BITS(Z)) u_depth (
        .clk_i(clk_i), .rst_i(rst_i), .beat_valid_i(beat_valid_i), .beat_ready_o(ready[0]),
        .beat_op_i(beat_op_i), .beat_save_i(beat_save_i), .beat_move_i(beat_move_i),
        .beat_y_move_i({`SAM_MOVE_BITS{1'b0}}), .beat_start_i(z_start_i), .beat_a_i(z_a_i),
        .beat_b_i({Z{1'b0}}), .beat_row_i(z_row_i), .beat_low_i({L{1'b0}}),
        .value_valid_o(valid[0]), .value_ready_i(value_ready_i), .value_value_o(depth),
        .value_a_o(depth_a), .value_b_o(depth_b), .value_low_o(depth_low)
    );
    sam_edge_interpolator #(.BITS(K), .SLOPE_BITS(K)) u_red (
        .clk_i(clk_i), .rst_i(rst_i), .beat_valid_i(beat_valid_i), .beat_ready_o(ready[1]),
        .beat_op_i(beat_op_i), .beat_save_i(beat_save_i), .beat_move_i(beat_move_i),
        .beat_y_move_i({`SAM_MOVE_BITS{1'b0}}), .beat_start_i(red_start_i), .beat_a_i(red_a_i),
        .beat_b_i({K{1'b0}}), .beat_row_i(red_row_i), .beat_low_i({L{1'b0}}),
        .value_valid_o(valid[1]), .value_ready_i(value_ready_i), .value_value_o(red),
        .value_a_o(red_a), .value_b_o(red_b), .value_low_o(red_low)
    );
    sam_edge_interpolator #(.BITS(K), .SLOPE_BITS(K)) u_green (
        .clk_i(clk_i), .rst_i(rst_i), .beat_valid_i(beat_valid_i), .beat_ready_o(ready[2]),
        .beat_op_i(beat_op_i), .beat_save_i(beat_save_i), .beat_move_i(beat_move_i),
        .beat_y_move_i({`SAM_MOVE_BITS{1'b0}}), .beat_start_i(green_start_i), .beat_a_i(green_a_i),
        .beat_b_i({K{1'b0}}), .beat_row_i(green_row_i), .beat_low_i({L{1'b0}}),
        .value_valid_o(valid[2]), .value_ready_i(value_ready_i), .value_value_o(green),
        .value_a_o(green_a), .value_b_o(green_b), .value_low_o(green_low)
    );
    sam_edge_interpolator #(.BITS(K), .SLOPE_BITS(K)) u_blue (
        .clk_i(clk_i), .rst_i(rst_i), .beat_valid_i(beat_valid_i), .beat_ready_o(ready[3]),
        .beat_op_i(beat_op_i), .beat_save_i(beat_save_i), .beat_move_i(beat_move_i),
        .beat_y_move_i({`SAM_MOVE_BITS{1'b0}}), .beat_start_i(blue_start_i), .beat_a_i(blue_a_i),
        .beat_b_i({K{1'b0}}), .beat_row_i(blue_row_i), .beat_low_i({L{1'b0}}),
        .value_valid_o(valid[3]), .value_ready_i(value_ready_i), .value_value_o(blue),
        .value_a_o(blue_a), .value_b_o(blue_b), .value_low_o(blue_low)
    );
    sam_edge_interpolator #(.BITS(K), .SLOPE_BITS(K)) u_alpha (
        .clk_i(clk_i), .rst_i(rst_i), .beat_valid_i(beat_valid_i), .beat_ready_o(ready[4]),
        .beat_op_i(beat_op_i), .beat_save_i(beat_save_i), .beat_move_i(beat_move_i),
        .beat_y_move_i({`SAM_MOVE_BITS{1'b0}}), .beat_start_i(alpha_start_i), .beat_a_i(alpha_a_i),
        .beat_b_i({K{1'b0}}), .beat_row_i(alpha_row_i), .beat_low_i({L{1'b0}}),
        .value_valid_o(valid[4]), .value_ready_i(value_ready_i), .value_value_o(alpha),
        .value_a_o(alpha_a), .value_b_o(alpha_b), .value_low_o(alpha_low)
    );

    sam_clamp #(.BITS(`SAM_DEPTH_BITS)) u_clamp_depth (.value_i(depth), .clamped_o(depth_o));
    sam_clamp #(.BITS(M)) u_clamp_red   (.value_i(red),   .clamped_o(rgba_o[0 +: M]));
    sam_clamp #(.BITS(M)) u_clamp_green (.value_i(green), .clamped_o(rgba_o[M +: M]));
    sam_clamp #(.BITS(M)) u_clamp_blue  (.value_i(blue),  .clamped_o(rgba_o[2*M +: M]));
    sam_clamp #(.BITS(M)) u_clamp_alpha (.value_i(alpha), .clamped_o(rgba_o[3*M +: M]));

    wire unused = &{
        1'b0, ready, valid, depth_a, depth_b, depth_low, red_a, red_b, red_low,
        green_a, green_b, green_low, blue_a, blue_b, blue_low, alpha_a, alpha_b, alpha_low
    };
endmodule

`default_nettype wire
