// Stereo pipeline: primary pipeline, hybrid secondary and redirection behind one polygon port. Setup
// values in, the pixels of both eyes out.
//
//   walk, planes -> primary -> beat -> hybrid -> request, left, right
//                 setup, edges, response ->
//
// The polygon port are the streams `walk`, `planes`, `setup` and `edges`: every part of a polygon has one
// record in each, taken where the part has got to, so that no record is held twice.
//
// Latency: two clocks more than sam_hybrid.
// Reset: as sam_primary and sam_hybrid.
// Paper: figure 4, with the primary pipeline.
`include "sam_formats.vh"
`default_nettype none

module sam_stereo #(
    // Fraction bits of a snapped vertex, sets the width of every coordinate: 4 or 8.
    parameter SUBPIXEL_BITS = 8,
    // Division of the box filter, 1/n as 2 or 3 powers of two or exact: 2, 3 or 0.
    parameter FILTER_TERMS = 0,
    // 16 coverage samples a pixel instead of one: 0 or 1.
    parameter ANTIALIAS = 0,
    // Interpolators for a colour of the secondary's own: 0 or 1.
    parameter INTEGRATED = 0,
    // Depth of the secondary interpolated instead of sampled: 0 or 1.
    parameter DEPTH_INTERPOLATED = 1,
    // Depth tested by the memory instead of here: 0 or 1.
    parameter DEPTH_EXTERNAL = 0,
    // Secondary y affine in both directions: 0 or 1.
    parameter TILT = 0,
    // Slots in flight between background read and output: 2, 4, 8, 16 or 32.
    parameter SLOTS = 16
) (
    input  wire                                           clk_i, rst_i,
    input  wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] width_i, height_i,
    input  wire                                           single_i, error_clear_i,
    output wire                                           error_o,

    input  wire                                           walk_valid_i,
    output wire                                           walk_ready_o,
    input  wire                                           walk_last_i, walk_creep_i, walk_swap_i, walk_mirror_i,
    input  wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] walk_rows_i, walk_y_i,
    input  wire [`SAM_DISPLAY_STEP_BITS-1:0]              walk_y_step_i,
    input  wire [`SAM_PIXEL_X_BITS(SUBPIXEL_BITS)-1:0]    walk_x_i, walk_x_row_i, walk_left_i, walk_right_i,
    input  wire [`SAM_EDGE_BITS(SUBPIXEL_BITS)-1:0]       walk_e0_start_i, walk_e0_row_i,
    input  wire [`SAM_SLOPE_BITS(SUBPIXEL_BITS)-1:0]      walk_e0_a_i, walk_e0_b_i,
    input  wire [`SAM_LOW_BITS-1:0]                       walk_e0_low_i,
    input  wire [`SAM_BOUND_BITS(SUBPIXEL_BITS)-1:0]      walk_e0_bound_i,
    input  wire [`SAM_EDGE_BITS(SUBPIXEL_BITS)-1:0]       walk_e1_start_i, walk_e1_row_i,
    input  wire [`SAM_SLOPE_BITS(SUBPIXEL_BITS)-1:0]      walk_e1_a_i, walk_e1_b_i,
    input  wire [`SAM_LOW_BITS-1:0]                       walk_e1_low_i,
    input  wire [`SAM_BOUND_BITS(SUBPIXEL_BITS)-1:0]      walk_e1_bound_i,
    input  wire [`SAM_EDGE_BITS(SUBPIXEL_BITS)-1:0]       walk_e2_start_i, walk_e2_row_i,
    input  wire [`SAM_SLOPE_BITS(SUBPIXEL_BITS)-1:0]      walk_e2_a_i, walk_e2_b_i,
    input  wire [`SAM_LOW_BITS-1:0]                       walk_e2_low_i,
    input  wire [`SAM_BOUND_BITS(SUBPIXEL_BITS)-1:0]      walk_e2_bound_i,

    input  wire                                           planes_valid_i,
    output wire                                           planes_ready_o,
    input  wire [`SAM_DEPTH_PLANE_BITS-1:0]               planes_z_start_i, planes_z_a_i, planes_z_row_i,
    input  wire [`SAM_COLOUR_PLANE_BITS-1:0]              planes_red_start_i, planes_red_a_i, planes_red_row_i,
    input  wire [`SAM_COLOUR_PLANE_BITS-1:0]              planes_green_start_i, planes_green_a_i, planes_green_row_i,
    input  wire [`SAM_COLOUR_PLANE_BITS-1:0]              planes_blue_start_i, planes_blue_a_i, planes_blue_row_i,
    input  wire [`SAM_COLOUR_PLANE_BITS-1:0]              planes_alpha_start_i, planes_alpha_a_i, planes_alpha_row_i,

    input  wire                                           setup_valid_i,
    output wire                                           setup_ready_o,
    input  wire [`SAM_MODE_BITS-1:0]                      setup_mode_i,
    input  wire                                           setup_lend_i, setup_average_i, setup_planes_i,
    input  wire [`SAM_X_BITS(SUBPIXEL_BITS)-1:0]          setup_x_start_i, setup_x_row_i,
    input  wire [`SAM_SCALE_BITS-1:0]                     setup_x_step_i,
    input  wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] setup_y_start_i,
    input  wire [`SAM_DISPLAY_STEP_BITS-1:0]              setup_y_step_i,
    input  wire                                           setup_swap_i, setup_mirror_i,
    input  wire [`SAM_X_BITS(SUBPIXEL_BITS)-1:0]          setup_y_view_i, setup_y_row_i,
    input  wire [`SAM_SLANT_BITS-1:0]                     setup_y_slant_i,

    input  wire                                           edges_valid_i,
    output wire                                           edges_ready_o,
    input  wire [`SAM_EDGE_BITS(SUBPIXEL_BITS)-1:0]       edges_e0_start_i, edges_e0_row_i,
    input  wire [`SAM_SLOPE_BITS(SUBPIXEL_BITS)-1:0]      edges_e0_a_i, edges_e0_b_i,
    input  wire [`SAM_LOW_BITS-1:0]                       edges_e0_low_i,
    input  wire [`SAM_EDGE_BITS(SUBPIXEL_BITS)-1:0]       edges_e1_start_i, edges_e1_row_i,
    input  wire [`SAM_SLOPE_BITS(SUBPIXEL_BITS)-1:0]      edges_e1_a_i, edges_e1_b_i,
    input  wire [`SAM_LOW_BITS-1:0]                       edges_e1_low_i,
    input  wire [`SAM_EDGE_BITS(SUBPIXEL_BITS)-1:0]       edges_e2_start_i, edges_e2_row_i,
    input  wire [`SAM_SLOPE_BITS(SUBPIXEL_BITS)-1:0]      edges_e2_a_i, edges_e2_b_i,
    input  wire [`SAM_LOW_BITS-1:0]                       edges_e2_low_i,
    input  wire [`SAM_DEPTH_PLANE_BITS-1:0]               edges_z_start_i, edges_z_a_i,
    input  wire [`SAM_DEPTH_PLANE_BITS-1:0]               edges_z_b_i, edges_z_row_i,
    input  wire [`SAM_COLOUR_PLANE_BITS-1:0]              edges_red_start_i, edges_red_a_i,
    input  wire [`SAM_COLOUR_PLANE_BITS-1:0]              edges_red_b_i, edges_red_row_i,
    input  wire [`SAM_COLOUR_PLANE_BITS-1:0]              edges_green_start_i, edges_green_a_i,
    input  wire [`SAM_COLOUR_PLANE_BITS-1:0]              edges_green_b_i, edges_green_row_i,
    input  wire [`SAM_COLOUR_PLANE_BITS-1:0]              edges_blue_start_i, edges_blue_a_i,
    input  wire [`SAM_COLOUR_PLANE_BITS-1:0]              edges_blue_b_i, edges_blue_row_i,

    output wire                                           request_valid_o,
    input  wire                                           request_ready_i,
    output wire                                           request_eye_o,
    output wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] request_x_o, request_y_o,

    input  wire                                           response_valid_i,
    output wire                                           response_ready_o,
    input  wire [`SAM_RGB_BITS-1:0]                       response_rgb_i,
    input  wire [`SAM_DEPTH_BITS-1:0]                     response_depth_i,

    output wire                                           left_valid_o,
    input  wire                                           left_ready_i,
    output wire                                           left_eye_o, left_write_o, left_blended_o,
    output wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] left_x_o, left_y_o,
    output wire [`SAM_RGBA_BITS-1:0]                      left_rgba_o,
    output wire [`SAM_AREA_BITS(ANTIALIAS)-1:0]           left_area_o,
    output wire [`SAM_DEPTH_BITS-1:0]                     left_depth_o,

    output wire                                           right_valid_o,
    input  wire                                           right_ready_i,
    output wire                                           right_eye_o, right_write_o, right_blended_o,
    output wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] right_x_o, right_y_o,
    output wire [`SAM_RGBA_BITS-1:0]                      right_rgba_o,
    output wire [`SAM_AREA_BITS(ANTIALIAS)-1:0]           right_area_o,
    output wire [`SAM_DEPTH_BITS-1:0]                     right_depth_o
);
    localparam C = `SAM_COORDINATE_BITS(SUBPIXEL_BITS);

    // The parameters are checked by the pipelines.

    wire                                 beat_valid, beat_ready, beat_save, beat_last, beat_centre;
    wire [`SAM_OP_BITS-1:0]              beat_op;
    wire [`SAM_MASK_BITS(ANTIALIAS)-1:0] beat_mask;
    wire [C-1:0]                         beat_x, beat_y;
    wire [`SAM_RGBA_BITS-1:0]            beat_rgba;
    wire [`SAM_DEPTH_BITS-1:0]           beat_depth;

    sam_primary #(.SUBPIXEL_BITS(SUBPIXEL_BITS), .ANTIALIAS(ANTIALIAS)) u_primary (
        .clk_i(clk_i), .rst_i(rst_i), .width_i(width_i),
        .walk_valid_i(walk_valid_i), .walk_ready_o(walk_ready_o), .walk_last_i(walk_last_i),
        .walk_creep_i(walk_creep_i), .walk_swap_i(walk_swap_i), .walk_mirror_i(walk_mirror_i),
        .walk_rows_i(walk_rows_i), .walk_y_i(walk_y_i), .walk_y_step_i(walk_y_step_i),
        .walk_x_i(walk_x_i), .walk_x_row_i(walk_x_row_i), .walk_left_i(walk_left_i),
        .walk_right_i(walk_right_i), .walk_e0_start_i(walk_e0_start_i),
        .walk_e0_row_i(walk_e0_row_i), .walk_e0_a_i(walk_e0_a_i), .walk_e0_b_i(walk_e0_b_i),
        .walk_e0_low_i(walk_e0_low_i), .walk_e0_bound_i(walk_e0_bound_i),
        .walk_e1_start_i(walk_e1_start_i), .walk_e1_row_i(walk_e1_row_i), .walk_e1_a_i(walk_e1_a_i),
        .walk_e1_b_i(walk_e1_b_i), .walk_e1_low_i(walk_e1_low_i), .walk_e1_bound_i(walk_e1_bound_i),
        .walk_e2_start_i(walk_e2_start_i), .walk_e2_row_i(walk_e2_row_i), .walk_e2_a_i(walk_e2_a_i),
        .walk_e2_b_i(walk_e2_b_i), .walk_e2_low_i(walk_e2_low_i), .walk_e2_bound_i(walk_e2_bound_i),
        .planes_valid_i(planes_valid_i), .planes_ready_o(planes_ready_o),
        .planes_z_start_i(planes_z_start_i), .planes_z_a_i(planes_z_a_i),
        .planes_z_row_i(planes_z_row_i), .planes_red_start_i(planes_red_start_i),
        .planes_red_a_i(planes_red_a_i), .planes_red_row_i(planes_red_row_i),
        .planes_green_start_i(planes_green_start_i), .planes_green_a_i(planes_green_a_i),
        .planes_green_row_i(planes_green_row_i), .planes_blue_start_i(planes_blue_start_i),
        .planes_blue_a_i(planes_blue_a_i), .planes_blue_row_i(planes_blue_row_i),
        .planes_alpha_start_i(planes_alpha_start_i), .planes_alpha_a_i(planes_alpha_a_i),
        .planes_alpha_row_i(planes_alpha_row_i),
        .beat_valid_o(beat_valid), .beat_ready_i(beat_ready),
        .beat_op_o(beat_op), .beat_save_o(beat_save), .beat_last_o(beat_last),
        .beat_centre_o(beat_centre), .beat_mask_o(beat_mask), .beat_x_o(beat_x), .beat_y_o(beat_y),
        .beat_rgba_o(beat_rgba), .beat_depth_o(beat_depth)
    );

    sam_hybrid #(
        .SUBPIXEL_BITS(SUBPIXEL_BITS), .FILTER_TERMS(FILTER_TERMS), .ANTIALIAS(ANTIALIAS),
        .INTEGRATED(INTEGRATED), .DEPTH_INTERPOLATED(DEPTH_INTERPOLATED),
        .DEPTH_EXTERNAL(DEPTH_EXTERNAL), .TILT(TILT), .SLOTS(SLOTS)
    ) u_hybrid (
        .clk_i(clk_i), .rst_i(rst_i),
        .width_i(width_i), .height_i(height_i), .single_i(single_i), .error_clear_i(error_clear_i),
        .error_o(error_o),
        .setup_valid_i(setup_valid_i), .setup_ready_o(setup_ready_o), .setup_mode_i(setup_mode_i),
        .setup_lend_i(setup_lend_i), .setup_average_i(setup_average_i),
        .setup_planes_i(setup_planes_i), .setup_x_start_i(setup_x_start_i),
        .setup_x_row_i(setup_x_row_i), .setup_x_step_i(setup_x_step_i),
        .setup_y_start_i(setup_y_start_i), .setup_y_step_i(setup_y_step_i),
        .setup_swap_i(setup_swap_i), .setup_mirror_i(setup_mirror_i),
        .setup_y_view_i(setup_y_view_i), .setup_y_row_i(setup_y_row_i),
        .setup_y_slant_i(setup_y_slant_i),
        .edges_valid_i(edges_valid_i), .edges_ready_o(edges_ready_o),
        .edges_e0_start_i(edges_e0_start_i), .edges_e0_row_i(edges_e0_row_i),
        .edges_e0_a_i(edges_e0_a_i), .edges_e0_b_i(edges_e0_b_i), .edges_e0_low_i(edges_e0_low_i),
        .edges_e1_start_i(edges_e1_start_i), .edges_e1_row_i(edges_e1_row_i),
        .edges_e1_a_i(edges_e1_a_i), .edges_e1_b_i(edges_e1_b_i), .edges_e1_low_i(edges_e1_low_i),
        .edges_e2_start_i(edges_e2_start_i), .edges_e2_row_i(edges_e2_row_i),
        .edges_e2_a_i(edges_e2_a_i), .edges_e2_b_i(edges_e2_b_i), .edges_e2_low_i(edges_e2_low_i),
        .edges_z_start_i(edges_z_start_i), .edges_z_a_i(edges_z_a_i), .edges_z_b_i(edges_z_b_i),
        .edges_z_row_i(edges_z_row_i), .edges_red_start_i(edges_red_start_i),
        .edges_red_a_i(edges_red_a_i), .edges_red_b_i(edges_red_b_i),
        .edges_red_row_i(edges_red_row_i), .edges_green_start_i(edges_green_start_i),
        .edges_green_a_i(edges_green_a_i), .edges_green_b_i(edges_green_b_i),
        .edges_green_row_i(edges_green_row_i), .edges_blue_start_i(edges_blue_start_i),
        .edges_blue_a_i(edges_blue_a_i), .edges_blue_b_i(edges_blue_b_i),
        .edges_blue_row_i(edges_blue_row_i),
        .beat_valid_i(beat_valid), .beat_ready_o(beat_ready),
        .beat_op_i(beat_op), .beat_save_i(beat_save), .beat_last_i(beat_last),
        .beat_centre_i(beat_centre), .beat_mask_i(beat_mask), .beat_x_i(beat_x), .beat_y_i(beat_y),
        .beat_rgba_i(beat_rgba), .beat_depth_i(beat_depth),
        .request_valid_o(request_valid_o), .request_ready_i(request_ready_i),
        .request_eye_o(request_eye_o), .request_x_o(request_x_o), .request_y_o(request_y_o),
        .response_valid_i(response_valid_i), .response_ready_o(response_ready_o),
        .response_rgb_i(response_rgb_i), .response_depth_i(response_depth_i),
        .left_valid_o(left_valid_o), .left_ready_i(left_ready_i), .left_eye_o(left_eye_o),
        .left_write_o(left_write_o), .left_blended_o(left_blended_o), .left_x_o(left_x_o),
        .left_y_o(left_y_o), .left_rgba_o(left_rgba_o), .left_area_o(left_area_o),
        .left_depth_o(left_depth_o), .right_valid_o(right_valid_o), .right_ready_i(right_ready_i),
        .right_eye_o(right_eye_o), .right_write_o(right_write_o), .right_blended_o(right_blended_o),
        .right_x_o(right_x_o), .right_y_o(right_y_o), .right_rgba_o(right_rgba_o),
        .right_area_o(right_area_o), .right_depth_o(right_depth_o)
    );

`ifdef FORMAL
`include "sam_formal.vh"
    `SAM_BEGIN

    // Memory that answers what was asked.
    reg [6:0] f_reads;
    always @(posedge clk_i) begin
        f_reads <= rst_i ? 0 : f_reads + (request_valid_o & request_ready_i) - (response_valid_i & response_ready_o);
        assume (~f_begun | ~response_valid_i | f_reads != 0);
        assume (`SAM_WAITS(response_valid_i, response_ready_o, {response_rgb_i, response_depth_i}));
    end

    // Parts that have begun without their planes; planes without their setup; setups without their edges.
    reg [3:0] f_walks, f_planes, f_setups;
    wire f_walk  = walk_valid_i & walk_ready_o,   f_plane = planes_valid_i & planes_ready_o;
    wire f_setup = setup_valid_i & setup_ready_o, f_edge  = edges_valid_i & edges_ready_o;
    always @(posedge clk_i) begin
        f_walks  <= rst_i ? 0 : f_walks + f_walk - f_plane;
        f_planes <= rst_i ? 0 : f_planes + f_plane - f_setup;
        f_setups <= rst_i ? 0 : f_setups + f_setup - f_edge;
        assume (~f_begun | $stable({single_i, width_i, height_i}));
        assume (`SAM_WAITS(setup_valid_i, setup_ready_o, {setup_mode_i, setup_x_start_i, setup_x_step_i, setup_lend_i,
            setup_average_i, setup_planes_i, setup_x_row_i, setup_y_start_i, setup_y_step_i, setup_swap_i,
            setup_mirror_i, setup_y_view_i, setup_y_slant_i, setup_y_row_i}));
    end

    always @(posedge clk_i) if (f_begun & ~rst_i) begin
        // A pixel that waits on the left is offered again, unchanged,
        p_left_stable: assert (`SAM_WAITS(left_valid_o, left_ready_i,
            {left_eye_o, left_x_o, left_y_o, left_rgba_o, left_area_o, left_depth_o, left_write_o, left_blended_o}));
        // and so is one on the right.
        p_right_stable: assert (`SAM_WAITS(right_valid_o, right_ready_i,
            {right_eye_o, right_x_o, right_y_o, right_rgba_o, right_area_o, right_depth_o, right_write_o, right_blended_o}));
        // With two streams each has the pixels of its eye, with one the right is silent.
        p_eyes: assert (single_i ? ~right_valid_o : (~left_valid_o | ~left_eye_o) & (~right_valid_o | right_eye_o));
        // A request that waits is offered again, unchanged.
        p_request_stable: assert (`SAM_WAITS(request_valid_o, request_ready_i, {request_eye_o, request_x_o, request_y_o}));
        // The four records of a part are taken in the order walk, planes, setup, edges, each once.
        p_records: assert (f_walks <= 1 & f_planes <= 1 & f_setups <= (SLOTS < 8 ? 1 : 2));
        // Nothing is drawn or read before the first part has all its records.
        p_nothing_made: assert (f_seen | ~(request_valid_o | left_valid_o | right_valid_o));
        // The error stays until it is cleared.
        p_error_stays: assert ($past(rst_i | ~error_o | error_clear_i) | error_o);
    end
    reg f_seen;
    always @(posedge clk_i) f_seen <= ~rst_i & (f_seen | f_edge);
`endif
endmodule

`default_nettype wire
