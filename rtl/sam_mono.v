// Monocular pipeline: the primary pipeline with a depth test and blending of its own, for one eye. What
// a stereo pipeline is compared with: two of these draw both eyes without it.
//
//   walk, planes -> primary -> area -> slot queue -> request     response -> blend -> pixel
//
// Latency: five clocks from `walk` to `request`, three from `response` to `pixel`; four and two with
// fewer than 8 slots.
// Reset: rst_i empties stages and queue; no data is reset.
// Paper: section 3; docs/mono.md.
`include "sam_formats.vh"
`default_nettype none

module sam_mono #(
    // Fraction bits of a snapped vertex, sets the width of every coordinate: 4 or 8.
    parameter SUBPIXEL_BITS = 8,
    // 16 coverage samples a pixel instead of one: 0 or 1.
    parameter ANTIALIAS = 0,
    // Depth tested by the memory instead of here: 0 or 1.
    parameter DEPTH_EXTERNAL = 0,
    // Slots in flight between background read and output: 2, 4, 8, 16 or 32.
    parameter SLOTS = 16
) (
    input  wire                                           clk_i, rst_i,
    input  wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] width_i,
    input  wire                                           eye_i,

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

    output wire                                           request_valid_o,
    input  wire                                           request_ready_i,
    output wire                                           request_eye_o,
    output wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] request_x_o, request_y_o,

    input  wire                                           response_valid_i,
    output wire                                           response_ready_o,
    input  wire [`SAM_RGB_BITS-1:0]                       response_rgb_i,
    input  wire [`SAM_DEPTH_BITS-1:0]                     response_depth_i,

    output wire                                           pixel_valid_o,
    input  wire                                           pixel_ready_i,
    output wire                                           pixel_eye_o, pixel_write_o, pixel_blended_o,
    output wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] pixel_x_o, pixel_y_o,
    output wire [`SAM_RGBA_BITS-1:0]                      pixel_rgba_o,
    output wire [`SAM_AREA_BITS(ANTIALIAS)-1:0]           pixel_area_o,
    output wire [`SAM_DEPTH_BITS-1:0]                     pixel_depth_o
);
    localparam C  = `SAM_COORDINATE_BITS(SUBPIXEL_BITS);
    localparam MB = `SAM_MASK_BITS(ANTIALIAS);
    localparam AB = `SAM_AREA_BITS(ANTIALIAS);
    localparam D  = `SAM_DEPTH_BITS;
    localparam RB = `SAM_RGBA_BITS;

    // The parameters are checked by the units that they are handed to.

    wire                    beat_valid, beat_ready, beat_save, beat_last, beat_centre;
    wire [`SAM_OP_BITS-1:0] beat_op;
    wire [MB-1:0]           beat_mask;
    wire [C-1:0]            beat_x, beat_y;
    wire [RB-1:0]           beat_rgba;
    wire [D-1:0]            beat_depth;

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

    wire [AB-1:0] area;
    wire          slot_valid, slot_ready, slot_write;
    wire [C-1:0]  slot_x, slot_y;
    wire [RB-1:0] slot_rgba;
    wire [AB-1:0] slot_area;
    wire [D-1:0]  slot_depth;

    sam_popcount #(.ANTIALIAS(ANTIALIAS)) u_area (.mask_i(beat_mask), .area_o(area));

    // Beats without a pixel end here.
    sam_stage #(.WIDTH(1 + 2 * C + RB + AB + D)) u_slot (
        .clk_i(clk_i), .rst_i(rst_i),
        .in_valid_i(beat_valid & (beat_mask != {MB{1'b0}})), .in_ready_o(beat_ready),
        .in_data_i({beat_centre, beat_x, beat_y, beat_rgba, area, beat_depth}),
        .out_valid_o(slot_valid), .out_ready_i(slot_ready),
        .out_data_o({slot_write, slot_x, slot_y, slot_rgba, slot_area, slot_depth})
    );

    wire           behind_valid, behind_ready, behind_visible;
    wire [RB-1:0]  behind_rgba;
    wire [AB-1:0]  behind_area;
    wire           colour_valid, colour_ready, colour_visible;
    wire [`SAM_RGB_BITS-1:0] behind_background, colour_rgb;
    wire           out_valid, out_primary, out_secondary, out_eye;
    wire [C-1:0]   out_primary_x, out_primary_y;
    wire [RB-1:0]  out_primary_rgba;
    wire [AB-1:0]  out_primary_area;
    wire [D-1:0]   out_primary_depth;
    wire           out_primary_write;

    // The pixel has the place of the queue's secondary, which belongs to the eye that is not the
    // slot's. In the place of the primary is nothing, which synthesis removes.
    sam_slot_queue #(
        .SUBPIXEL_BITS(SUBPIXEL_BITS), .ANTIALIAS(ANTIALIAS), .DEPTH_EXTERNAL(DEPTH_EXTERNAL),
        .SLOTS(SLOTS)
    ) u_slot_queue (
        .clk_i(clk_i), .rst_i(rst_i), .single_i(1'b0),
        .next_eye_i(eye_i), .next_x_i(beat_x), .next_y_i(beat_y),
        .slot_valid_i(slot_valid), .slot_ready_o(slot_ready),
        .slot_primary_i(1'b0), .slot_secondary_i(1'b1), .slot_eye_i(~eye_i),
        .slot_primary_x_i({C{1'b0}}), .slot_primary_y_i({C{1'b0}}),
        .slot_primary_rgba_i({RB{1'b0}}), .slot_primary_area_i({AB{1'b0}}),
        .slot_primary_depth_i({D{1'b0}}), .slot_primary_write_i(1'b0),
        .slot_secondary_x_i(slot_x), .slot_secondary_y_i(slot_y),
        .slot_secondary_rgba_i(slot_rgba), .slot_secondary_area_i(slot_area),
        .slot_secondary_depth_i(slot_depth), .slot_secondary_write_i(slot_write),
        .request_valid_o(request_valid_o), .request_ready_i(request_ready_i),
        .request_eye_o(request_eye_o), .request_x_o(request_x_o), .request_y_o(request_y_o),
        .response_valid_i(response_valid_i), .response_ready_o(response_ready_o),
        .response_rgb_i(response_rgb_i), .response_depth_i(response_depth_i),
        .pixel_valid_o(behind_valid), .pixel_ready_i(behind_ready), .pixel_rgba_o(behind_rgba),
        .pixel_area_o(behind_area), .pixel_background_o(behind_background),
        .pixel_visible_o(behind_visible),
        .colour_valid_i(colour_valid), .colour_ready_o(colour_ready), .colour_rgb_i(colour_rgb),
        .colour_visible_i(colour_visible),
        .out_valid_o(out_valid), .out_ready_i(pixel_ready_i), .out_primary_o(out_primary),
        .out_secondary_o(out_secondary), .out_blended_o(pixel_blended_o), .out_eye_o(out_eye),
        .out_primary_x_o(out_primary_x), .out_primary_y_o(out_primary_y),
        .out_primary_rgba_o(out_primary_rgba), .out_primary_area_o(out_primary_area),
        .out_primary_depth_o(out_primary_depth), .out_primary_write_o(out_primary_write),
        .out_secondary_x_o(pixel_x_o), .out_secondary_y_o(pixel_y_o),
        .out_secondary_rgba_o(pixel_rgba_o), .out_secondary_area_o(pixel_area_o),
        .out_secondary_depth_o(pixel_depth_o), .out_secondary_write_o(pixel_write_o)
    );

    sam_blend #(.ANTIALIAS(ANTIALIAS), .TAG_BITS(1)) u_blend (
        .clk_i(clk_i), .rst_i(rst_i),
        .pixel_valid_i(behind_valid), .pixel_ready_o(behind_ready),
        .pixel_rgb_i(behind_rgba[`SAM_RGB_BITS-1:0]),
        .pixel_alpha_i(behind_rgba[RB-1:`SAM_RGB_BITS]), .pixel_area_i(behind_area),
        .pixel_background_i(behind_background), .pixel_tag_i(behind_visible),
        .colour_valid_o(colour_valid), .colour_ready_i(colour_ready),
        .colour_rgb_o(colour_rgb), .colour_tag_o(colour_visible)
    );

    assign pixel_valid_o = out_valid;
    assign pixel_eye_o   = ~out_eye;

    wire unused = &{
        1'b0, beat_op, beat_save, beat_last, out_primary, out_secondary, out_primary_x, out_primary_y,
        out_primary_rgba, out_primary_area, out_primary_depth, out_primary_write
    };

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

    reg [3:0] f_drawn, f_asked, f_walks;
    always @(posedge clk_i) begin
        f_walks <= rst_i ? 0 : f_walks + (walk_valid_i & walk_ready_o) - (planes_valid_i & planes_ready_o);
        f_asked <= rst_i ? 0 : f_asked + (request_valid_o & request_ready_i);
        f_drawn <= rst_i ? 0 : f_drawn + (pixel_valid_o & pixel_ready_i);
        assume (~f_begun | $stable({eye_i, width_i}));
    end

    always @(posedge clk_i) if (f_begun & ~rst_i) begin
        // A request that waits is offered again, unchanged.
        p_request_stable: assert (`SAM_WAITS(request_valid_o, request_ready_i, {request_eye_o, request_x_o, request_y_o}));
        // A pixel that waits is offered again, unchanged.
        p_stable: assert (`SAM_WAITS(pixel_valid_o, pixel_ready_i, {pixel_eye_o, pixel_write_o, pixel_blended_o,
                          pixel_x_o, pixel_y_o, pixel_rgba_o, pixel_area_o, pixel_depth_o}));
        // All pixels and reads are of the one eye.
        p_eye: assert ((~pixel_valid_o | pixel_eye_o == eye_i) & (~request_valid_o | request_eye_o == eye_i));
        // No more pixels come than were read for, and each says that it is blended.
        p_nothing_made: assert (f_drawn + pixel_valid_o <= f_asked & (~pixel_valid_o | pixel_blended_o));
        // Planes are taken with their parts: at most one is before its planes.
        p_planes: assert (f_walks <= 1);
    end
`endif
endmodule

`default_nettype wire
