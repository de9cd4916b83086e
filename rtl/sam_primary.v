// Primary pipeline: an ordinary scan-line rasteriser of triangles, and the source of the beats that a
// secondary pipeline lives on. Setup values in, no divider.
//
//   walk -> traversal -> coverage, display place
//           planes    -> depth, colour, alpha    -> beat
//
// Latency: two clocks from `walk` to `beat`, then a beat a clock, parts without a gap.
// Reset: rst_i empties the stages; no data is reset.
// Paper: sections 3 and 5 (the pipeline that the secondary is added to); docs/primary.md.
`include "sam_formats.vh"
`default_nettype none

module sam_primary #(
    // Fraction bits of a snapped vertex, sets the width of every coordinate: 4 or 8.
    parameter SUBPIXEL_BITS = 8,
    // 16 coverage samples a pixel instead of one: 0 or 1.
    parameter ANTIALIAS = 0
) (
    input  wire                                           clk_i, rst_i,
    input  wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] width_i,

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

    output wire                                           beat_valid_o,
    input  wire                                           beat_ready_i,
    output wire [`SAM_OP_BITS-1:0]                        beat_op_o,
    output wire                                           beat_save_o, beat_last_o, beat_centre_o,
    output wire [`SAM_MASK_BITS(ANTIALIAS)-1:0]           beat_mask_o,
    output wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] beat_x_o, beat_y_o,
    output wire [`SAM_RGBA_BITS-1:0]                      beat_rgba_o,
    output wire [`SAM_DEPTH_BITS-1:0]                     beat_depth_o
);
    localparam P  = `SAM_PIXEL_X_BITS(SUBPIXEL_BITS);
    localparam C  = `SAM_COORDINATE_BITS(SUBPIXEL_BITS);
    localparam EB = `SAM_EDGE_BITS(SUBPIXEL_BITS);
    localparam SB = `SAM_SLOPE_BITS(SUBPIXEL_BITS);
    localparam LB = `SAM_LOW_BITS;
    localparam MB = `SAM_MASK_BITS(ANTIALIAS);
    localparam OB = `SAM_OP_BITS;

    // The parameters are checked by the units that they are handed to.

    wire          visited, visit_ready, visit_save, visit_last, visit_move, visit_swap, visit_mirror;
    wire [OB-1:0] visit_op;
    wire [P-1:0]  visit_x;
    wire [C-1:0]  visit_y;
    wire [EB-1:0] value0, value1, value2;
    wire [SB-1:0] a0, a1, a2, b0, b1, b2;
    wire [LB-1:0] low0, low1, low2;

    sam_traversal #(.SUBPIXEL_BITS(SUBPIXEL_BITS)) u_traversal (
        .clk_i(clk_i), .rst_i(rst_i),
        .walk_valid_i(walk_valid_i), .walk_ready_o(walk_ready_o), .walk_last_i(walk_last_i),
        .walk_creep_i(walk_creep_i), .walk_rows_i(walk_rows_i), .walk_x_i(walk_x_i),
        .walk_x_row_i(walk_x_row_i), .walk_left_i(walk_left_i), .walk_right_i(walk_right_i),
        .walk_y_i(walk_y_i), .walk_y_step_i(walk_y_step_i), .walk_swap_i(walk_swap_i),
        .walk_mirror_i(walk_mirror_i), .walk_e0_start_i(walk_e0_start_i),
        .walk_e0_a_i(walk_e0_a_i), .walk_e0_b_i(walk_e0_b_i), .walk_e0_row_i(walk_e0_row_i),
        .walk_e0_low_i(walk_e0_low_i), .walk_e0_bound_i(walk_e0_bound_i),
        .walk_e1_start_i(walk_e1_start_i), .walk_e1_a_i(walk_e1_a_i), .walk_e1_b_i(walk_e1_b_i),
        .walk_e1_row_i(walk_e1_row_i), .walk_e1_low_i(walk_e1_low_i),
        .walk_e1_bound_i(walk_e1_bound_i), .walk_e2_start_i(walk_e2_start_i),
        .walk_e2_a_i(walk_e2_a_i), .walk_e2_b_i(walk_e2_b_i), .walk_e2_row_i(walk_e2_row_i),
        .walk_e2_low_i(walk_e2_low_i), .walk_e2_bound_i(walk_e2_bound_i),
        .visit_valid_o(visited), .visit_ready_i(visit_ready), .visit_op_o(visit_op),
        .visit_save_o(visit_save), .visit_last_o(visit_last), .visit_move_o(visit_move),
        .visit_swap_o(visit_swap), .visit_mirror_o(visit_mirror),
        .visit_x_o(visit_x), .visit_y_o(visit_y),
        .visit_value0_o(value0), .visit_a0_o(a0), .visit_b0_o(b0), .visit_low0_o(low0),
        .visit_value1_o(value1), .visit_a1_o(a1), .visit_b1_o(b1), .visit_low1_o(low1),
        .visit_value2_o(value2), .visit_a2_o(a2), .visit_b2_o(b2), .visit_low2_o(low2)
    );

    // A LOAD is offered with its planes. All units that follow move together.
    wire is_load = visit_op == `SAM_OP_LOAD;
    wire offered = visited & (~is_load | planes_valid_i);
    wire stage_ready;

    assign visit_ready    = stage_ready & (~is_load | planes_valid_i);
    assign planes_ready_o = stage_ready & visited & is_load;

    wire [MB-1:0]                        mask;
    wire [`SAM_AREA_BITS(ANTIALIAS)-1:0] area;
    wire                                 centre, coverage_ready, coverage_valid;

    sam_coverage #(.SUBPIXEL_BITS(SUBPIXEL_BITS), .ANTIALIAS(ANTIALIAS)) u_coverage (
        .clk_i(clk_i), .rst_i(rst_i),
        .edges_valid_i(offered), .edges_ready_o(coverage_ready),
        .edges_value0_i(value0), .edges_a0_i(a0), .edges_b0_i(b0), .edges_low0_i(low0),
        .edges_value1_i(value1), .edges_a1_i(a1), .edges_b1_i(b1), .edges_low1_i(low1),
        .edges_value2_i(value2), .edges_a2_i(a2), .edges_b2_i(b2), .edges_low2_i(low2),
        .coverage_valid_o(coverage_valid), .coverage_ready_i(stage_ready),
        .coverage_mask_o(mask), .coverage_area_o(area), .coverage_centre_o(centre)
    );

    // A negative x is a large number without its sign.
    wire in_view = visit_x < {{(P - C){1'b0}}, width_i};

    sam_stage #(.WIDTH(OB + 3 + MB)) u_flags (
        .clk_i(clk_i), .rst_i(rst_i), .in_valid_i(offered), .in_ready_o(stage_ready),
        .in_data_i({visit_op, visit_save, visit_last, centre, mask & {MB{in_view}}}),
        .out_valid_o(beat_valid_o), .out_ready_i(beat_ready_i),
        .out_data_o({beat_op_o, beat_save_o, beat_last_o, beat_centre_o, beat_mask_o})
    );

    wire display_ready, display_valid;

    sam_display #(.SUBPIXEL_BITS(SUBPIXEL_BITS)) u_display (
        .clk_i(clk_i), .rst_i(rst_i), .width_i(width_i),
        .point_valid_i(offered), .point_ready_o(display_ready), .point_x_i(visit_x),
        .point_y_i(visit_y), .point_swap_i(visit_swap), .point_mirror_i(visit_mirror),
        .pixel_valid_o(display_valid), .pixel_ready_i(beat_ready_i),
        .pixel_x_o(beat_x_o), .pixel_y_o(beat_y_o)
    );

    sam_primary_planes u_planes (
        .clk_i(clk_i), .rst_i(rst_i), .beat_valid_i(offered),
        .beat_op_i(visit_op), .beat_save_i(visit_save), .beat_move_i(visit_move),
        .z_start_i(planes_z_start_i), .z_a_i(planes_z_a_i), .z_row_i(planes_z_row_i),
        .red_start_i(planes_red_start_i), .red_a_i(planes_red_a_i), .red_row_i(planes_red_row_i),
        .green_start_i(planes_green_start_i), .green_a_i(planes_green_a_i),
        .green_row_i(planes_green_row_i), .blue_start_i(planes_blue_start_i),
        .blue_a_i(planes_blue_a_i), .blue_row_i(planes_blue_row_i),
        .alpha_start_i(planes_alpha_start_i), .alpha_a_i(planes_alpha_a_i),
        .alpha_row_i(planes_alpha_row_i),
        .value_ready_i(beat_ready_i), .depth_o(beat_depth_o), .rgba_o(beat_rgba_o)
    );

    wire unused = &{1'b0, area, coverage_ready, coverage_valid, display_ready, display_valid};

`ifdef FORMAL
`include "sam_formal.vh"
    `SAM_BEGIN
    // Parts that have begun and whose planes were taken, and beats, told from the ports.
    wire f_walk   = walk_valid_i & walk_ready_o;
    wire f_planes = planes_valid_i & planes_ready_o;
    wire f_beat   = beat_valid_o & beat_ready_i;
    reg [2:0] f_walks, f_planed;
    reg       f_lasts, f_open;
    always @(posedge clk_i) begin
        f_walks  <= rst_i ? 0 : f_walks + f_walk - f_planes;
        f_planed <= rst_i ? 0 : f_planed + f_planes - (f_beat & beat_op_o == `SAM_OP_LOAD);
        f_open   <= ~rst_i & (f_beat ? ~beat_last_o : f_open);
        assume (`SAM_WAITS(walk_valid_i, walk_ready_o, {walk_last_i, walk_creep_i, walk_rows_i, walk_x_i,
                walk_x_row_i, walk_left_i, walk_right_i, walk_y_i, walk_y_step_i, walk_swap_i, walk_mirror_i}));
        assume (`SAM_WAITS(planes_valid_i, planes_ready_o, {planes_z_start_i, planes_z_a_i, planes_z_row_i}));
        assume (~f_begun | $stable(width_i));
    end

    always @(posedge clk_i) if (f_begun) begin
        // A beat that waits is offered again, unchanged.
        p_stable: assert (`SAM_WAITS(beat_valid_o, beat_ready_i, {beat_op_o, beat_save_o, beat_last_o,
                          beat_centre_o, beat_mask_o, beat_x_o, beat_y_o, beat_rgba_o, beat_depth_o}));
        // Planes are taken by a part that was taken, each by one: at most one part is before its planes.
        p_planes: assert (f_walks <= 1);
        // A LOAD comes out for each record of planes, once.
        p_loads: assert (f_planed <= 1 & (~beat_valid_o | (beat_op_o == `SAM_OP_LOAD) <= f_planed));
        // After a reset and after a last beat comes a LOAD.
        p_first: assert (~beat_valid_o | f_open | beat_op_o == `SAM_OP_LOAD);
        // A LOAD is a row start.
        p_saves: assert (~beat_valid_o | beat_op_o != `SAM_OP_LOAD | beat_save_o);
        // Without samples a pixel is drawn only where its centre is covered.
        p_mask: assert (ANTIALIAS == 1 | ~beat_valid_o | beat_centre_o | ~beat_mask_o);
        // Lemma: where the LOADs are.
        lemma: assert (f_walks == (visited & is_load) & f_planed == (beat_valid_o & beat_op_o == `SAM_OP_LOAD));
    end
`endif
endmodule

`default_nettype wire
