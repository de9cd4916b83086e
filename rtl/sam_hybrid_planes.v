// Part of the hybrid system's second stage: the interpolators of the secondary's own depth and
// colour, and their results clamped to the ranges of a pixel. Options that are off leave nothing.
//
// Latency: one clock, in step with the edge interpolators.
// Reset: as sam_edge_interpolator.
// Paper: section 5.5 (integrated support).
`include "sam_formats.vh"
`default_nettype none

module sam_hybrid_planes #(
    // Interpolators for a colour of the secondary's own: 0 or 1.
    parameter INTEGRATED = 0,
    // Depth of the secondary interpolated instead of sampled: 0 or 1.
    parameter DEPTH_INTERPOLATED = 1,
    // Secondary y affine in both directions: 0 or 1.
    parameter TILT = 0
) (
    input  wire                              clk_i, rst_i,

    input  wire                              beat_valid_i,
    input  wire [`SAM_OP_BITS-1:0]           beat_op_i,
    input  wire                              beat_save_i, beat_move_i,
    input  wire [`SAM_MOVE_BITS-1:0]         beat_y_move_i,
    input  wire [`SAM_DEPTH_PLANE_BITS-1:0]  z_start_i, z_a_i, z_b_i, z_row_i,
    input  wire [`SAM_COLOUR_PLANE_BITS-1:0] red_start_i, red_a_i, red_b_i, red_row_i,
    input  wire [`SAM_COLOUR_PLANE_BITS-1:0] green_start_i, green_a_i, green_b_i, green_row_i,
    input  wire [`SAM_COLOUR_PLANE_BITS-1:0] blue_start_i, blue_a_i, blue_b_i, blue_row_i,

    input  wire                              value_ready_i,
    output wire [`SAM_DEPTH_BITS-1:0]        depth_o,
    output wire [`SAM_RGB_BITS-1:0]          rgb_o
);
    localparam Z = `SAM_DEPTH_PLANE_BITS;
    localparam K = `SAM_COLOUR_PLANE_BITS;
    localparam L = `SAM_LOW_BITS;
    localparam M = `SAM_CHANNEL_BITS;

    generate
        if (INTEGRATED != 0 && INTEGRATED != 1) begin : g_illegal_integrated
            sam_hybrid_planes_INTEGRATED_must_be_0_or_1 u_error ();
        end
        if (DEPTH_INTERPOLATED != 0 && DEPTH_INTERPOLATED != 1) begin : g_illegal_depth
            sam_hybrid_planes_DEPTH_INTERPOLATED_must_be_0_or_1 u_error ();
        end

        if (DEPTH_INTERPOLATED == 1) begin : g_depth
            wire [Z-1:0] value, a, b;
            wire [L-1:0] low;
            wire         ready, valid;

            sam_edge_interpolator #(.BITS(Z), .SLOPE_BITS(Z), .TILT(TILT)) u_depth (
                .clk_i(clk_i), .rst_i(rst_i), .beat_valid_i(beat_valid_i), .beat_ready_o(ready),
                .beat_op_i(beat_op_i), .beat_save_i(beat_save_i), .beat_move_i(beat_move_i),
                .beat_y_move_i(beat_y_move_i), .beat_start_i(z_start_i), .beat_a_i(z_a_i),
                .beat_b_i(z_b_i), .beat_row_i(z_row_i), .beat_low_i({L{1'b0}}),
                .value_valid_o(valid), .value_ready_i(value_ready_i), .value_value_o(value),
                .value_a_o(a), .value_b_o(b), .value_low_o(low)
            );
            sam_clamp #(.BITS(`SAM_DEPTH_BITS)) u_clamp (.value_i(value), .clamped_o(depth_o));
            wire unused = &{1'b0, ready, valid, a, b, low};
        end else begin : g_no_depth
            assign depth_o = {`SAM_DEPTH_BITS{1'b0}};
            wire unused = &{1'b0, z_start_i, z_a_i, z_b_i, z_row_i};
        end

        if (INTEGRATED == 1) begin : g_colour
            wire [K-1:0] red, red_a, red_b, green, green_a, green_b, blue, blue_a, blue_b;
            wire [L-1:0] red_low, green_low, blue_low;
            wire [2:0]   ready, valid;

            sam_edge_interpolator #(.BITS(K), .SLOPE_BITS(K), .TILT(TILT)) u_red (
                .clk_i(clk_i), .rst_i(rst_i), .beat_valid_i(beat_valid_i), .beat_ready_o(ready[0]),
                .beat_op_i(beat_op_i), .beat_save_i(beat_save_i), .beat_move_i(beat_move_i),
                .beat_y_move_i(beat_y_move_i), .beat_start_i(red_start_i), .beat_a_i(red_a_i),
                .beat_b_i(red_b_i), .beat_row_i(red_row_i), .beat_low_i({L{1'b0}}),
                .value_valid_o(valid[0]), .value_ready_i(value_ready_i), .value_value_o(red),
                .value_a_o(red_a), .value_b_o(red_b), .value_low_o(red_low)
            );
            sam_edge_interpolator #(.BITS(K), .SLOPE_BITS(K), .TILT(TILT)) u_green (
                .clk_i(clk_i), .rst_i(rst_i), .beat_valid_i(beat_valid_i), .beat_ready_o(ready[1]),
                .beat_op_i(beat_op_i), .beat_save_i(beat_save_i), .beat_move_i(beat_move_i),
                .beat_y_move_i(beat_y_move_i), .beat_start_i(green_start_i), .beat_a_i(green_a_i),
                .beat_b_i(green_b_i), .beat_row_i(green_row_i), .beat_low_i({L{1'b0}}),
                .value_valid_o(valid[1]), .value_ready_i(value_ready_i), .value_value_o(green),
                .value_a_o(green_a), .value_b_o(green_b), .value_low_o(green_low)
            );
            sam_edge_interpolator #(.BITS(K), .SLOPE_BITS(K), .TILT(TILT)) u_blue (
                .clk_i(clk_i), .rst_i(rst_i), .beat_valid_i(beat_valid_i), .beat_ready_o(ready[2]),
                .beat_op_i(beat_op_i), .beat_save_i(beat_save_i), .beat_move_i(beat_move_i),
                .beat_y_move_i(beat_y_move_i), .beat_start_i(blue_start_i), .beat_a_i(blue_a_i),
                .beat_b_i(blue_b_i), .beat_row_i(blue_row_i), .beat_low_i({L{1'b0}}),
                .value_valid_o(valid[2]), .value_ready_i(value_ready_i), .value_value_o(blue),
                .value_a_o(blue_a), .value_b_o(blue_b), .value_low_o(blue_low)
            );
            sam_clamp #(.BITS(M)) u_clamp_red   (.value_i(red),   .clamped_o(rgb_o[0 +: M]));
            sam_clamp #(.BITS(M)) u_clamp_green (.value_i(green), .clamped_o(rgb_o[M +: M]));
            sam_clamp #(.BITS(M)) u_clamp_blue  (.value_i(blue),  .clamped_o(rgb_o[2*M +: M]));
            wire unused = &{
                1'b0, ready, valid, red_a, red_b, red_low, green_a, green_b, green_low,
                blue_a, blue_b, blue_low
            };
        end else begin : g_no_colour
            assign rgb_o = {`SAM_RGB_BITS{1'b0}};
            wire unused = &{
                1'b0, red_start_i, red_a_i, red_b_i, red_row_i, green_start_i, green_a_i,
                green_b_i, green_row_i, blue_start_i, blue_a_i, blue_b_i, blue_row_i
            };
        end

        if (DEPTH_INTERPOLATED == 0 && INTEGRATED == 0) begin : g_nothing
            wire unused = &{
                1'b0, clk_i, rst_i, beat_valid_i, beat_op_i, beat_save_i, beat_move_i,
                beat_y_move_i, value_ready_i
            };
        end
    endgenerate

`ifdef FORMAL
`include "sam_formal.vh"
    `SAM_BEGIN
    // The planes of a polygon, told from the ports: depth, red, green and blue, which share a width.
    wire [4*Z-1:0] f_starts = {{16'd0, blue_start_i}, {16'd0, green_start_i}, {16'd0, red_start_i}, z_start_i};
    wire [4*Z-1:0] f_slopes = {{16'd0, blue_a_i}, {16'd0, green_a_i}, {16'd0, red_a_i}, z_a_i};
    wire [4*Z-1:0] f_tilts  = {{16'd0, blue_b_i}, {16'd0, green_b_i}, {16'd0, red_b_i}, z_b_i};
    wire [4*Z-1:0] f_rows   = {{16'd0, blue_row_i}, {16'd0, green_row_i}, {16'd0, red_row_i}, z_row_i};
    wire f_take = beat_valid_i & (~f_held | value_ready_i);
    `SAM_HELD(f_held, f_take, value_ready_i)
    wire [3:0] f_good;
    genvar f_i;
    generate
        for (f_i = 0; f_i < 4; f_i = f_i + 1) begin : g_f
            localparam B = f_i == 0 ? Z : K;
            reg  [B-1:0] f_value, f_saved, f_a, f_b, f_row;
            wire [B-1:0] f_up = TILT == 0 | beat_y_move_i == 0 ? 0 : beat_y_move_i == 1 ? f_b
                              : beat_y_move_i == 3 ? -f_b : -f_b - f_b;
            wire [B-1:0] f_next = beat_op_i == `SAM_OP_LOAD ? f_starts[f_i*Z +: B]
                : (beat_op_i == `SAM_OP_ROW ? f_saved + f_row : f_value) + (beat_move_i ? f_a : 0) + f_up;
            // Rounded down, into the range.
            wire signed [B-15:0] f_floor = f_value[B-1:14];
            wire [23:0] f_most  = f_i == 0 ? 24'hffffff : 24'hff;
            wire [23:0] f_shown = f_floor < 0 ? 0 : f_floor > $signed({1'b0, f_most}) ? f_most : f_floor;
            wire [23:0] f_out   = f_i == 0 ? depth_o : rgb_o[8*(f_i + 2) % 24 +: 8];
            always @(posedge clk_i) if (f_take) begin
                f_value <= f_next;
                if (beat_save_i) f_saved <= f_next;
                if (beat_op_i == `SAM_OP_LOAD) {f_a, f_b, f_row}
                    <= {f_slopes[f_i*Z +: B], f_tilts[f_i*Z +: B], f_rows[f_i*Z +: B]};
            end
            assign f_good[f_i] = f_out == f_shown;
        end
    endgenerate
    reg f_loaded = 1'b0;
    always @(posedge clk_i) f_loaded <= f_loaded | (f_begun & f_take & beat_op_i == `SAM_OP_LOAD & beat_save_i);

    always @(posedge clk_i) if (f_begun & f_loaded) begin
        // The depth is the floor of its plane, kept within 24 bits; 0 where it is not interpolated.
        p_depth: assert (DEPTH_INTERPOLATED == 0 ? depth_o == 0 : f_good[0]);
        // Each channel is the floor of its own plane, kept within 8 bits; 0 where there are none.
        p_channels: assert (INTEGRATED == 0 ? rgb_o == 0 : f_good[3:1] == 3'h7);
    end
`endif
endmodule

`default_nettype wire
