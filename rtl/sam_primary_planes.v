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

`ifdef FORMAL
`include "sam_formal.vh"
    `SAM_BEGIN
    // The planes of a polygon, told from the ports: depth, red, green, blue and alpha, which share a width.
    wire [5*Z-1:0] f_starts = {{16'd0, alpha_start_i}, {16'd0, blue_start_i}, {16'd0, green_start_i}, {16'd0, red_start_i}, z_start_i};
    wire [5*Z-1:0] f_slopes = {{16'd0, alpha_a_i}, {16'd0, blue_a_i}, {16'd0, green_a_i}, {16'd0, red_a_i}, z_a_i};
    wire [5*Z-1:0] f_rows = {{16'd0, alpha_row_i}, {16'd0, blue_row_i}, {16'd0, green_row_i}, {16'd0, red_row_i}, z_row_i};
    wire f_take = beat_valid_i & ready[0];
    wire [4:0] f_good;
    genvar f_i;
    generate
        for (f_i = 0; f_i < 5; f_i = f_i + 1) begin : g_f
            localparam B = f_i == 0 ? Z : K;
            reg  [B-1:0] f_value, f_saved, f_a, f_row;
            wire [B-1:0] f_next = beat_op_i == `SAM_OP_LOAD ? f_starts[f_i*Z +: B]
                : (beat_op_i == `SAM_OP_ROW ? f_saved + f_row : f_value) + (beat_move_i ? f_a : 0);
            // Rounded down, into the range.
            wire signed [B-15:0] f_floor = f_value[B-1:14];
            wire [23:0] f_most = f_i == 0 ? 24'hffffff : 24'hff;
            wire [23:0] f_shown = f_floor < 0 ? 0 : f_floor > $signed({1'b0, f_most}) ? f_most : f_floor;
            wire [23:0] f_out = f_i == 0 ? depth_o : rgba_o[8*(f_i + 3) % 32 +: 8];
            always @(posedge clk_i) if (f_take) begin
                f_value <= f_next;
                if (beat_save_i) f_saved <= f_next;
                if (beat_op_i == `SAM_OP_LOAD) {f_a, f_row} <= {f_slopes[f_i*Z +: B], f_rows[f_i*Z +: B]};
            end
            assign f_good[f_i] = f_out == f_shown;
        end
    endgenerate
    reg f_loaded = 1'b0;
    always @(posedge clk_i) f_loaded <= f_loaded | (f_begun & f_take & beat_op_i == `SAM_OP_LOAD & beat_save_i);

    always @(posedge clk_i) if (f_begun & f_loaded) begin
        // The depth is the floor of its plane, kept within 24 bits.
        p_depth: assert (f_good[0]);
        // Each channel is the floor of its own plane, kept within 8 bits.
        p_channels: assert (f_good[4:1] == 4'hf);
    end
    always @(posedge clk_i) if (f_begun) begin
        // The planes move together.
        p_together: assert ((ready == 0 | ready == 5'h1f) & (valid == 0 | valid == 5'h1f));
    end
`endif
endmodule

`default_nettype wire
