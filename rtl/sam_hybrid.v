// Hybrid system: derivation by the spatial mapping, with the secondary polygon's own edges, box
// filter, interpolated depth and colour, coverage, depth test and blending.
//
//   S1  setup, beat  -> x and y interpolator
//   S2  edges        -> edges 0 to 2, depth, colour planes, display, sampler, filter
//   S3                  coverage, choice of colour and depth -> slot
//       slot -> slot queue -> request     response -> blend -> redirect -> left, right
//
// Latency: five clocks to `request`, and three from `response` to `left` and `right`; three and two
// with fewer than 8 slots. The first stage waits for the next beat (or `last`).
// Reset: rst_i clears the stages' valids, empties the queue, clears redirect's notes and the
// error, and makes beats void until a LOAD; no data is reset.
// Paper: section 5, figure 4.
`include "sam_formats.vh"
`default_nettype none

module sam_hybrid #(
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
    // Slots in flight between background read and output: 2, 4, 8, 16 or 32. Fewer than 8 build the
    // pipeline of fewest gates, 8 and more the one of the fastest clock.
    parameter SLOTS = 16
) (
    input  wire                                           clk_i, rst_i,
    input  wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] width_i, height_i,
    input  wire                                           single_i, error_clear_i,
    output wire                                           error_o,

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

    input  wire                                           beat_valid_i,
    output wire                                           beat_ready_o,
    input  wire [`SAM_OP_BITS-1:0]                        beat_op_i,
    input  wire                                           beat_save_i, beat_last_i, beat_centre_i,
    input  wire [`SAM_MASK_BITS(ANTIALIAS)-1:0]           beat_mask_i,
    input  wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] beat_x_i, beat_y_i,
    input  wire [`SAM_RGBA_BITS-1:0]                      beat_rgba_i,
    input  wire [`SAM_DEPTH_BITS-1:0]                     beat_depth_i,

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
    localparam P  = `SAM_PIXEL_X_BITS(SUBPIXEL_BITS);
    localparam C  = `SAM_COORDINATE_BITS(SUBPIXEL_BITS);
    localparam EB = `SAM_EDGE_BITS(SUBPIXEL_BITS);
    localparam SB = `SAM_SLOPE_BITS(SUBPIXEL_BITS);
    localparam LB = `SAM_LOW_BITS;
    localparam MB = `SAM_MASK_BITS(ANTIALIAS);
    localparam D  = `SAM_DEPTH_BITS;
    localparam RB = `SAM_RGBA_BITS;
    // An interpolated depth needs no sampled one.
    localparam SAMPLE = DEPTH_INTERPOLATED == 1 ? RB : RB + D;

    generate
        if (INTEGRATED != 0 && INTEGRATED != 1) begin : g_illegal_integrated
            sam_hybrid_INTEGRATED_must_be_0_or_1 u_error ();
        end
        if (DEPTH_INTERPOLATED != 0 && DEPTH_INTERPOLATED != 1) begin : g_illegal_depth_interpolated
            sam_hybrid_DEPTH_INTERPOLATED_must_be_0_or_1 u_error ();
        end
        // The other parameters are checked by the units that they are handed to.
    endgenerate

    // S1: where the beat falls in the secondary. A LOAD beat is offered with its setup.
    wire is_load = beat_op_i == `SAM_OP_LOAD;
    wire offered = beat_valid_i & (~is_load | setup_valid_i);
    wire xy_valid, xy_taken, s1_ready;

    assign beat_ready_o  = s1_ready & ~(beat_valid_i & ~offered);
    assign setup_ready_o = s1_ready & beat_valid_i & is_load;

    wire [`SAM_OP_BITS-1:0]   xy_op;
    wire [P-1:0]              xy_column;
    wire [C-1:0]              xy_row;
    wire [`SAM_MOVE_BITS-1:0] xy_row_move;
    wire xy_save, xy_last, xy_move, xy_near, xy_x_inside, xy_x_end, xy_y_inside, xy_y_end;
    wire y_valid, y_ready;

    sam_x_interpolator #(.SUBPIXEL_BITS(SUBPIXEL_BITS)) u_x_interpolator (
        .clk_i(clk_i), .rst_i(rst_i), .width_i(width_i),
        .beat_valid_i(offered), .beat_ready_o(s1_ready),
        .beat_op_i(beat_op_i), .beat_save_i(beat_save_i), .beat_last_i(beat_last_i),
        .beat_start_i(setup_x_start_i), .beat_step_i(setup_x_step_i), .beat_row_i(setup_x_row_i),
        .pixel_valid_o(xy_valid), .pixel_ready_i(xy_taken),
        .pixel_op_o(xy_op), .pixel_save_o(xy_save), .pixel_last_o(xy_last),
        .pixel_x_o(xy_column), .pixel_move_o(xy_move), .pixel_near_o(xy_near),
        .pixel_inside_o(xy_x_inside), .pixel_end_o(xy_x_end)
    );

    sam_y_interpolator #(.SUBPIXEL_BITS(SUBPIXEL_BITS), .TILT(TILT)) u_y_interpolator (
        .clk_i(clk_i), .rst_i(rst_i), .height_i(height_i),
        .beat_valid_i(offered), .beat_ready_o(y_ready),
        .beat_op_i(beat_op_i), .beat_save_i(beat_save_i), .beat_last_i(beat_last_i),
        .beat_start_i(setup_y_start_i), .beat_step_i(setup_y_step_i), .beat_view_i(setup_y_view_i),
        .beat_slant_i(setup_y_slant_i), .beat_row_i(setup_y_row_i),
        .pixel_valid_o(y_valid), .pixel_ready_i(xy_taken),
        .pixel_y_o(xy_row), .pixel_move_o(xy_row_move),
        .pixel_inside_o(xy_y_inside), .pixel_end_o(xy_y_end)
    );

    wire xy_refused, xy_eye, xy_binocular, xy_lend, xy_average, xy_planes, xy_swap, xy_mirror;

    sam_polygon #(.SUBPIXEL_BITS(SUBPIXEL_BITS), .LEND(1)) u_polygon (
        .clk_i(clk_i), .rst_i(rst_i), .accept_i(offered & s1_ready), .op_i(beat_op_i),
        .setup_mode_i(setup_mode_i), .setup_lend_i(setup_lend_i),
        .setup_average_i(setup_average_i), .setup_planes_i(setup_planes_i),
        .setup_x_start_i(setup_x_start_i[`SAM_FRACTION_BITS +: P]),
        .setup_x_step_i(setup_x_step_i), .setup_swap_i(setup_swap_i),
        .setup_mirror_i(setup_mirror_i),
        .void_o(xy_refused), .eye_o(xy_eye), .binocular_o(xy_binocular), .lend_o(xy_lend),
        .average_o(xy_average), .planes_o(xy_planes), .swap_o(xy_swap), .mirror_o(xy_mirror)
    );

    reg           xy_centre_q;
    reg [MB-1:0]  xy_mask_q;
    reg [2*C-1:0] xy_place_q;
    reg [RB-1:0]  xy_rgba_q;
    reg [D-1:0]   xy_depth_q;

    always @(posedge clk_i) begin
        if (offered & s1_ready) begin
            xy_centre_q <= beat_centre_i;
            xy_mask_q   <= beat_mask_i;
            xy_place_q  <= {beat_x_i, beat_y_i};
            xy_rgba_q   <= beat_rgba_i;
            xy_depth_q  <= beat_depth_i;
        end
    end

    // With many slots a register is behind these units: the next beat shows late in a clock whether
    // this one leaves and ends its pixel, and all of S2 depends on that.
    localparam W = `SAM_OP_BITS + P + C + `SAM_MOVE_BITS + 17 + MB + 2 * C + RB + D;
    wire xy_load = xy_op == `SAM_OP_LOAD;
    wire [W-1:0] xy = {
        xy_op, xy_load, xy_column, xy_row, xy_row_move, xy_save, xy_move, xy_near, xy_x_inside, xy_x_end,
        xy_y_inside, xy_y_end, xy_refused, xy_eye, xy_binocular, xy_lend, xy_average, xy_planes,
        xy_swap, xy_mirror, xy_centre_q, xy_mask_q, xy_place_q, xy_rgba_q, xy_depth_q
    };
    wire [W-1:0] s1;
    wire         s1_valid, s1_taken;

    generate
        if (SLOTS < 8) begin : g_short
            assign s1       = xy;
            assign s1_valid = xy_valid;
            assign xy_taken = s1_taken;
        end else begin : g_long
            sam_stage #(.WIDTH(W)) u_xy (
                .clk_i(clk_i), .rst_i(rst_i),
                .in_valid_i(xy_valid), .in_ready_o(xy_taken), .in_data_i(xy),
                .out_valid_o(s1_valid), .out_ready_i(s1_taken), .out_data_o(s1)
            );
        end
    endgenerate

    wire [`SAM_OP_BITS-1:0]   s1_op;
    wire [P-1:0]              s1_column;
    wire [C-1:0]              s1_row;
    wire [`SAM_MOVE_BITS-1:0] s1_row_move;
    wire s1_load, s1_save, s1_move, s1_near, s1_x_inside, s1_x_end, s1_y_inside, s1_y_end;
    wire s1_refused, s1_eye, s1_binocular, s1_lend, s1_average, s1_planes, s1_swap, s1_mirror;
    wire s1_centre;
    wire [MB-1:0]  s1_mask;
    wire [2*C-1:0] s1_place;
    wire [RB-1:0]  s1_rgba;
    wire [D-1:0]   s1_depth;

    assign {
        s1_op, s1_load, s1_column, s1_row, s1_row_move, s1_save, s1_move, s1_near, s1_x_inside, s1_x_end,
        s1_y_inside, s1_y_end, s1_refused, s1_eye, s1_binocular, s1_lend, s1_average, s1_planes,
        s1_swap, s1_mirror, s1_centre, s1_mask, s1_place, s1_rgba, s1_depth
    } = s1;

    // Into S2: a LOAD beat is offered with its edges. All units of S2 move together. The sampler and
    // the filter have room between the ends of pixels even when the stage has not: they get a beat
    // when it moves.
    wire s1_first   = (s1_op != `SAM_OP_STEP) | s1_move | (s1_row_move != {`SAM_MOVE_BITS{1'b0}});
    wire s1_end     = s1_x_end | s1_y_end;
    wire s2_valid, s2_ready, s3_ready;
    wire s1_offered = s1_valid & (~s1_load | edges_valid_i);
    wire s1_moves   = s1_offered & s2_ready;

    assign s1_taken      = s2_ready & (~s1_load | edges_valid_i);
    assign edges_ready_o = s2_ready & s1_valid & s1_load;

    // A binocular polygon without area shows in its edges only.
    reg  flat_q;
    wire flat   = s1_binocular & (edges_e0_a_i == {SB{1'b0}}) & (edges_e1_a_i == {SB{1'b0}})
                               & (edges_e2_a_i == {SB{1'b0}});
    wire s1_void = s1_refused | (s1_load ? flat : flat_q);

    reg error_q;
    assign error_o = error_q;

    always @(posedge clk_i) begin
        if (s1_moves & s1_load) flat_q <= flat;

        if (rst_i) error_q <= 1'b0;
        else       error_q <= (error_q & ~error_clear_i) | (s1_moves & s1_void);
    end

    // S2: the interpolants at the secondary pixel, and what is gathered of its primary pixels.
    wire           s2_draw, s2_secondary, s2_eye, s2_lend, s2_average, s2_planes, s2_centre;
    wire [MB-1:0]  s2_mask;
    wire [2*C-1:0] s2_place;
    wire [RB-1:0]  s2_rgba;
    wire [D-1:0]   s2_depth;

    sam_stage #(.WIDTH(7 + MB + 2 * C + RB + D)) u_primary (
        .clk_i(clk_i), .rst_i(rst_i),
        .in_valid_i(s1_offered), .in_ready_o(s2_ready),
        .in_data_i({~s1_void, ~s1_void & s1_binocular & s1_end & s1_x_inside & s1_y_inside,
                    s1_eye, s1_lend, s1_average, s1_planes, s1_centre,
                    s1_mask, s1_place, s1_rgba, s1_depth}),
        .out_valid_o(s2_valid), .out_ready_i(s3_ready),
        .out_data_o({s2_draw, s2_secondary, s2_eye, s2_lend, s2_average, s2_planes, s2_centre,
                     s2_mask, s2_place, s2_rgba, s2_depth})
    );

    wire [EB-1:0] value0, value1, value2;
    wire [SB-1:0] a0, a1, a2, b0, b1, b2;
    wire [LB-1:0] low0, low1, low2;
    wire [2:0]    edge_ready, edge_valid;

    sam_edge_interpolator #(.BITS(EB), .SLOPE_BITS(SB), .TILT(TILT)) u_edge0 (
        .clk_i(clk_i), .rst_i(rst_i),
        .beat_valid_i(s1_offered), .beat_ready_o(edge_ready[0]), .beat_op_i(s1_op), .beat_save_i(s1_save),
        .beat_move_i(s1_move), .beat_y_move_i(s1_row_move),
        .beat_start_i(edges_e0_start_i), .beat_a_i(edges_e0_a_i), .beat_b_i(edges_e0_b_i),
        .beat_row_i(edges_e0_row_i), .beat_low_i(edges_e0_low_i),
        .value_valid_o(edge_valid[0]), .value_ready_i(s3_ready),
        .value_value_o(value0), .value_a_o(a0), .value_b_o(b0), .value_low_o(low0)
    );

    sam_edge_interpolator #(.BITS(EB), .SLOPE_BITS(SB), .TILT(TILT)) u_edge1 (
        .clk_i(clk_i), .rst_i(rst_i),
        .beat_valid_i(s1_offered), .beat_ready_o(edge_ready[1]), .beat_op_i(s1_op), .beat_save_i(s1_save),
        .beat_move_i(s1_move), .beat_y_move_i(s1_row_move),
        .beat_start_i(edges_e1_start_i), .beat_a_i(edges_e1_a_i), .beat_b_i(edges_e1_b_i),
        .beat_row_i(edges_e1_row_i), .beat_low_i(edges_e1_low_i),
        .value_valid_o(edge_valid[1]), .value_ready_i(s3_ready),
        .value_value_o(value1), .value_a_o(a1), .value_b_o(b1), .value_low_o(low1)
    );

    sam_edge_interpolator #(.BITS(EB), .SLOPE_BITS(SB), .TILT(TILT)) u_edge2 (
        .clk_i(clk_i), .rst_i(rst_i),
        .beat_valid_i(s1_offered), .beat_ready_o(edge_ready[2]), .beat_op_i(s1_op), .beat_save_i(s1_save),
        .beat_move_i(s1_move), .beat_y_move_i(s1_row_move),
        .beat_start_i(edges_e2_start_i), .beat_a_i(edges_e2_a_i), .beat_b_i(edges_e2_b_i),
        .beat_row_i(edges_e2_row_i), .beat_low_i(edges_e2_low_i),
        .value_valid_o(edge_valid[2]), .value_ready_i(s3_ready),
        .value_value_o(value2), .value_a_o(a2), .value_b_o(b2), .value_low_o(low2)
    );

    wire                  display_ready, display_valid, sampler_ready, sampler_valid, hit;
    wire                  filter_ready, filter_valid;
    wire [C-1:0]          column, row;
    wire [RB+D-1:0]       s1_data = {s1_depth, s1_rgba};
    wire [RB+D-1:0]       sample;
    wire [RB-1:0]         average;
    wire [`SAM_COUNT_BITS-1:0] count;

    sam_display #(.SUBPIXEL_BITS(SUBPIXEL_BITS)) u_display (
        .clk_i(clk_i), .rst_i(rst_i), .width_i(width_i),
        .point_valid_i(s1_offered), .point_ready_o(display_ready), .point_x_i(s1_column),
        .point_y_i(s1_row), .point_swap_i(s1_swap), .point_mirror_i(s1_mirror),
        .pixel_valid_o(display_valid), .pixel_ready_i(s3_ready), .pixel_x_o(column), .pixel_y_o(row)
    );

    sam_filter #(.FILTER_TERMS(FILTER_TERMS)) u_filter (
        .clk_i(clk_i), .rst_i(rst_i),
        .beat_valid_i(s1_moves), .beat_ready_o(filter_ready), .beat_first_i(s1_first),
        .beat_end_i(s1_end), .beat_include_i(s1_centre), .beat_rgba_i(s1_rgba),
        .pixel_valid_o(filter_valid), .pixel_ready_i(s3_ready),
        .pixel_rgba_o(average), .pixel_count_o(count)
    );

    sam_sampler #(.WIDTH(SAMPLE)) u_sampler (
        .clk_i(clk_i), .rst_i(rst_i),
        .beat_valid_i(s1_moves), .beat_ready_o(sampler_ready), .beat_first_i(s1_first),
        .beat_end_i(s1_end), .beat_near_i(s1_near), .beat_take_i(1'b1),
        .beat_data_i(s1_data[SAMPLE-1:0]),
        .sample_valid_o(sampler_valid), .sample_ready_i(s3_ready),
        .sample_data_o(sample[SAMPLE-1:0]), .sample_hit_o(hit)
    );
    generate
        if (DEPTH_INTERPOLATED == 1) begin : g_no_sampled_depth
            assign sample[RB +: D] = {D{1'b0}};
        end
    endgenerate

    wire [D-1:0]               plane_depth;
    wire [`SAM_RGB_BITS-1:0]   plane_rgb;

    sam_hybrid_planes #(
        .INTEGRATED(INTEGRATED), .DEPTH_INTERPOLATED(DEPTH_INTERPOLATED), .TILT(TILT)
    ) u_planes (
        .clk_i(clk_i), .rst_i(rst_i), .beat_valid_i(s1_offered), .value_ready_i(s3_ready),
        .beat_op_i(s1_op), .beat_save_i(s1_save), .beat_move_i(s1_move), .beat_y_move_i(s1_row_move),
        .z_start_i(edges_z_start_i), .z_a_i(edges_z_a_i), .z_b_i(edges_z_b_i), .z_row_i(edges_z_row_i),
        .red_start_i(edges_red_start_i), .red_a_i(edges_red_a_i),
        .red_b_i(edges_red_b_i), .red_row_i(edges_red_row_i),
        .green_start_i(edges_green_start_i), .green_a_i(edges_green_a_i),
        .green_b_i(edges_green_b_i), .green_row_i(edges_green_row_i),
        .blue_start_i(edges_blue_start_i), .blue_a_i(edges_blue_a_i),
        .blue_b_i(edges_blue_b_i), .blue_row_i(edges_blue_row_i),
        .depth_o(plane_depth), .rgb_o(plane_rgb)
    );

    sam_hybrid_back #(
        .SUBPIXEL_BITS(SUBPIXEL_BITS), .ANTIALIAS(ANTIALIAS), .INTEGRATED(INTEGRATED),
        .DEPTH_INTERPOLATED(DEPTH_INTERPOLATED), .DEPTH_EXTERNAL(DEPTH_EXTERNAL), .SLOTS(SLOTS)
    ) u_back (
        .clk_i(clk_i), .rst_i(rst_i), .single_i(single_i),
        .s2_valid_i(s2_valid), .s3_ready_o(s3_ready),
        .s2_draw_i(s2_draw), .s2_secondary_i(s2_secondary), .s2_eye_i(s2_eye), .s2_lend_i(s2_lend),
        .s2_average_i(s2_average), .s2_planes_i(s2_planes), .s2_centre_i(s2_centre),
        .s2_mask_i(s2_mask), .s2_place_i(s2_place), .s2_rgba_i(s2_rgba), .s2_depth_i(s2_depth),
        .edges_value0_i(value0), .edges_a0_i(a0), .edges_b0_i(b0), .edges_low0_i(low0),
        .edges_value1_i(value1), .edges_a1_i(a1), .edges_b1_i(b1), .edges_low1_i(low1),
        .edges_value2_i(value2), .edges_a2_i(a2), .edges_b2_i(b2), .edges_low2_i(low2),
        .column_i(column), .row_i(row), .sample_i(sample), .average_i(average), .count_i(count),
        .plane_depth_i(plane_depth), .plane_rgb_i(plane_rgb),
        .request_valid_o(request_valid_o), .request_ready_i(request_ready_i),
        .request_eye_o(request_eye_o), .request_x_o(request_x_o), .request_y_o(request_y_o),
        .response_valid_i(response_valid_i), .response_ready_o(response_ready_o),
        .response_rgb_i(response_rgb_i), .response_depth_i(response_depth_i),
        .left_valid_o(left_valid_o), .left_ready_i(left_ready_i), .left_eye_o(left_eye_o),
        .left_x_o(left_x_o), .left_y_o(left_y_o), .left_rgba_o(left_rgba_o),
        .left_area_o(left_area_o), .left_depth_o(left_depth_o), .left_write_o(left_write_o),
        .left_blended_o(left_blended_o),
        .right_valid_o(right_valid_o), .right_ready_i(right_ready_i), .right_eye_o(right_eye_o),
        .right_x_o(right_x_o), .right_y_o(right_y_o), .right_rgba_o(right_rgba_o),
        .right_area_o(right_area_o), .right_depth_o(right_depth_o), .right_write_o(right_write_o),
        .right_blended_o(right_blended_o)
    );

    wire unused = &{
        1'b0, xy_last, y_valid, y_ready, edge_ready, edge_valid, display_ready, display_valid,
        sampler_ready, sampler_valid, hit, filter_ready, filter_valid, s1_data
    };

`ifdef FORMAL
`include "sam_formal.vh"
    `SAM_BEGIN
    // What was taken, told from the ports.
    wire f_take  = beat_valid_i & beat_ready_o;
    wire f_setup = setup_valid_i & setup_ready_o;
    // A polygon that no mode allows, or none yet, and then nothing else.
    wire f_illegal = setup_mode_i > 3 | (setup_mode_i[1] & (setup_lend_i | setup_x_step_i < 565
                                                            | setup_x_step_i > 1 << `SAM_FRACTION_BITS));
    reg f_void, f_bad;
    wire f_load   = f_take & beat_op_i == `SAM_OP_LOAD;
    wire f_starts = f_load & ~f_illegal;
    // Which of the last three beats are of such a polygon, the latest first, if the error was not cleared since.
    reg  [2:0] f_due;
    wire f_bad_beat = f_load ? f_illegal : f_bad;
    always @(posedge clk_i) begin
        f_void <= rst_i | (f_void & ~f_starts);
        f_bad  <= rst_i | f_bad_beat;
        f_due  <= rst_i | error_clear_i ? 0 : f_take ? {f_due[1:0], f_bad_beat} : f_due;
        assume (`SAM_WAITS(beat_valid_i, beat_ready_o, {beat_op_i, beat_save_i, beat_last_i, beat_centre_i,
                           beat_mask_i, beat_x_i, beat_y_i, beat_rgba_i, beat_depth_i}));
        assume (`SAM_WAITS(setup_valid_i, setup_ready_o, {setup_mode_i, setup_lend_i, setup_average_i,
            setup_planes_i, setup_x_start_i, setup_x_step_i, setup_x_row_i, setup_y_start_i, setup_y_step_i,
            setup_swap_i, setup_mirror_i, setup_y_view_i, setup_y_slant_i, setup_y_row_i}));
        assume (~f_begun | $stable({width_i, height_i, single_i}));
    end

    // Memory that answers what was asked.
    reg [6:0] f_reads;
    always @(posedge clk_i) begin
        f_reads <= rst_i ? 0 : f_reads + (request_valid_o & request_ready_i) - (response_valid_i & response_ready_o);
        assume (~f_begun | ~response_valid_i | f_reads != 0);
        assume (`SAM_WAITS(response_valid_i, response_ready_o, {response_rgb_i, response_depth_i}));
    end

    // Clocks that a beat has waited while all round it is ready, whatever was before.
    reg [5:0] f_waited;
    wire f_eager = left_ready_i & right_ready_i & request_ready_i & (response_valid_i | f_reads == 0)
                 & beat_valid_i & (setup_valid_i | beat_op_i != `SAM_OP_LOAD) & edges_valid_i;
    always @(posedge clk_i) f_waited <= rst_i | ~f_eager | beat_ready_o ? 0 : f_waited + 1;

    wire f_edges = edges_valid_i & edges_ready_o;
    reg [3:0] f_loads;
    always @(posedge clk_i) f_loads <= rst_i ? 0 : f_loads + (f_take & beat_op_i == `SAM_OP_LOAD) - f_edges;

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
        // A setup is taken with its LOAD, and with nothing else.
        p_setup: assert (f_setup == (f_take & beat_op_i == `SAM_OP_LOAD));
        // Edges are taken once for each LOAD; at most one LOAD, with 8 slots or more two, waits for its edges.
        p_edges: assert (f_loads <= (SLOTS < 8 ? 1 : 2));
        // Where all is ready a beat waits no longer than all slots take to leave, and 8 clocks, whatever the
        // setups were: nothing hangs.
        p_never_hangs: assert (f_waited <= SLOTS + 8);
        // Before a good setup nothing is read or drawn.
        p_void: assert (~f_void | (~request_valid_o & ~left_valid_o & ~right_valid_o));
        // The error is up at the latest when the third beat after a bad one has been taken, unless cleared meanwhile,
        p_error_rises: assert ($past(rst_i | ~f_take | ~f_due[2] | error_clear_i) | error_o);
        // and stays until it is cleared.
        p_error_stays: assert ($past(rst_i | ~error_o | error_clear_i) | error_o);
    end
`endif
endmodule

`default_nettype wire
