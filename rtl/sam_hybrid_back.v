// Third stage of the hybrid system and what follows it: the slot of a primary and a secondary
// pixel is put together, waits for the background, is blended and sent to its eyes.
//
//   coverage, choice of colour and depth -> slot -> slot queue, blend -> redirect
//
// Latency: two clocks to `request`, three from `response` to `left` and `right`; one and two with
// fewer than 8 slots.
// Reset: rst_i empties stages and queue; no data is reset.
// Paper: section 5, figure 4.
`include "sam_formats.vh"
`default_nettype none

module sam_hybrid_back #(
    // Fraction bits of a snapped vertex, sets the width of every coordinate: 4 or 8.
    parameter SUBPIXEL_BITS = 8,
    // 16 coverage samples a pixel instead of one: 0 or 1.
    parameter ANTIALIAS = 0,
    // A colour of the secondary's own can be chosen: 0 or 1.
    parameter INTEGRATED = 0,
    // Depth of the secondary interpolated instead of sampled: 0 or 1.
    parameter DEPTH_INTERPOLATED = 1,
    // Depth tested by the memory instead of here: 0 or 1.
    parameter DEPTH_EXTERNAL = 0,
    // Slots in flight between background read and output: 2, 4, 8, 16 or 32.
    parameter SLOTS = 16
) (
    input  wire                                             clk_i, rst_i, single_i,

    input  wire                                             s2_valid_i,
    output wire                                             s3_ready_o,
    input  wire                                             s2_draw_i, s2_secondary_i, s2_eye_i,
    input  wire                                             s2_lend_i, s2_average_i, s2_planes_i,
    input  wire                                             s2_centre_i,
    input  wire [`SAM_MASK_BITS(ANTIALIAS)-1:0]             s2_mask_i,
    input  wire [2*`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] s2_place_i,
    input  wire [`SAM_RGBA_BITS-1:0]                        s2_rgba_i,
    input  wire [`SAM_DEPTH_BITS-1:0]                       s2_depth_i,
    input  wire [`SAM_EDGE_BITS(SUBPIXEL_BITS)-1:0]         edges_value0_i, edges_value1_i,
    input  wire [`SAM_EDGE_BITS(SUBPIXEL_BITS)-1:0]         edges_value2_i,
    input  wire [`SAM_SLOPE_BITS(SUBPIXEL_BITS)-1:0]        edges_a0_i, edges_a1_i, edges_a2_i,
    input  wire [`SAM_SLOPE_BITS(SUBPIXEL_BITS)-1:0]        edges_b0_i, edges_b1_i, edges_b2_i,
    input  wire [`SAM_LOW_BITS-1:0]                         edges_low0_i, edges_low1_i, edges_low2_i,
    input  wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0]   column_i, row_i,
    input  wire [`SAM_DEPTH_BITS+`SAM_RGBA_BITS-1:0]        sample_i,
    input  wire [`SAM_RGBA_BITS-1:0]                        average_i,
    input  wire [`SAM_COUNT_BITS-1:0]                       count_i,
    input  wire [`SAM_DEPTH_BITS-1:0]                       plane_depth_i,
    input  wire [`SAM_RGB_BITS-1:0]                         plane_rgb_i,

    output wire                                             request_valid_o,
    input  wire                                             request_ready_i,
    output wire                                             request_eye_o,
    output wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0]   request_x_o, request_y_o,

    input  wire                                             response_valid_i,
    output wire                                             response_ready_o,
    input  wire [`SAM_RGB_BITS-1:0]                         response_rgb_i,
    input  wire [`SAM_DEPTH_BITS-1:0]                       response_depth_i,

    output wire                                             left_valid_o,
    input  wire                                             left_ready_i,
    output wire                                             left_eye_o, left_write_o, left_blended_o,
    output wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0]   left_x_o, left_y_o,
    output wire [`SAM_RGBA_BITS-1:0]                        left_rgba_o,
    output wire [`SAM_AREA_BITS(ANTIALIAS)-1:0]             left_area_o,
    output wire [`SAM_DEPTH_BITS-1:0]                       left_depth_o,

    output wire                                             right_valid_o,
    input  wire                                             right_ready_i,
    output wire                                             right_eye_o, right_write_o, right_blended_o,
    output wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0]   right_x_o, right_y_o,
    output wire [`SAM_RGBA_BITS-1:0]                        right_rgba_o,
    output wire [`SAM_AREA_BITS(ANTIALIAS)-1:0]             right_area_o,
    output wire [`SAM_DEPTH_BITS-1:0]                       right_depth_o
);
    localparam C  = `SAM_COORDINATE_BITS(SUBPIXEL_BITS);
    localparam MB = `SAM_MASK_BITS(ANTIALIAS);
    localparam AB = `SAM_AREA_BITS(ANTIALIAS);
    localparam D  = `SAM_DEPTH_BITS;
    localparam RB = `SAM_RGBA_BITS;

    generate
        if (INTEGRATED != 0 && INTEGRATED != 1) begin : g_illegal_integrated
            sam_hybrid_back_INTEGRATED_must_be_0_or_1 u_error ();
        end
        if (DEPTH_INTERPOLATED != 0 && DEPTH_INTERPOLATED != 1) begin : g_illegal_depth
            sam_hybrid_back_DEPTH_INTERPOLATED_must_be_0_or_1 u_error ();
        end
    endgenerate

    // S3: what each eye gets of the beat.
    wire [MB-1:0] mask;
    wire [AB-1:0] area, primary_area;
    wire          centre, edges_ready, coverage_valid;

    sam_coverage #(.SUBPIXEL_BITS(SUBPIXEL_BITS), .ANTIALIAS(ANTIALIAS)) u_coverage (
        .clk_i(clk_i), .rst_i(rst_i),
        .edges_valid_i(s2_valid_i), .edges_ready_o(edges_ready),
        .edges_value0_i(edges_value0_i), .edges_a0_i(edges_a0_i), .edges_b0_i(edges_b0_i),
        .edges_low0_i(edges_low0_i),
        .edges_value1_i(edges_value1_i), .edges_a1_i(edges_a1_i), .edges_b1_i(edges_b1_i),
        .edges_low1_i(edges_low1_i),
        .edges_value2_i(edges_value2_i), .edges_a2_i(edges_a2_i), .edges_b2_i(edges_b2_i),
        .edges_low2_i(edges_low2_i),
        .coverage_valid_o(coverage_valid), .coverage_ready_i(s3_ready_o),
        .coverage_mask_o(mask), .coverage_area_o(area), .coverage_centre_o(centre)
    );

    wire [MB-1:0] primary_mask = s2_mask_i & (mask | {MB{~s2_lend_i}});

    sam_popcount #(.ANTIALIAS(ANTIALIAS)) u_area (.mask_i(primary_mask), .area_o(primary_area));

    wire primary       = s2_draw_i & (primary_mask != {MB{1'b0}});
    wire primary_write = s2_centre_i & (centre | ~s2_lend_i);
    wire secondary     = s2_secondary_i & (area != {AB{1'b0}});
    wire filtered      = s2_average_i & (count_i != {`SAM_COUNT_BITS{1'b0}});
    wire integrated    = s2_planes_i & (INTEGRATED != 0);

    // A colour that is not the filter's. The choice between the two comes behind the register, as
    // the filter's exact division fills the clock before it.
    wire [RB-1:0] plain = {
        sample_i[RB-1:`SAM_RGB_BITS], integrated ? plane_rgb_i : sample_i[`SAM_RGB_BITS-1:0]
    };
    wire [D-1:0]  depth;

    generate
        if (DEPTH_INTERPOLATED == 1) begin : g_interpolated
            assign depth = plane_depth_i;
            wire unused = &{1'b0, sample_i[RB +: D]};
        end else begin : g_sampled
            assign depth = sample_i[RB +: D];
            wire unused = &{1'b0, plane_depth_i};
        end
    endgenerate

    wire           slot_valid, slot_ready;
    wire           slot_primary, slot_secondary, slot_eye, slot_primary_write, slot_secondary_write;
    wire [2*C-1:0] slot_primary_place, slot_secondary_place;
    wire           slot_average_alpha, slot_average_rgb;
    wire [RB-1:0]  slot_primary_rgba, slot_average, slot_plain;
    wire [AB-1:0]  slot_primary_area, slot_secondary_area;
    wire [D-1:0]   slot_primary_depth, slot_secondary_depth;

    // Beats without a pixel end here. They are taken when any beat would be, so that the coverage
    // is not in the path of s3_ready.
    sam_stage #(.WIDTH(7 + 4 * C + 3 * RB + 2 * (AB + D))) u_slot (
        .clk_i(clk_i), .rst_i(rst_i),
        .in_valid_i(s2_valid_i & (primary | secondary)), .in_ready_o(s3_ready_o),
        .in_data_i({primary, secondary, s2_eye_i, primary_write, centre,
                    filtered, filtered & ~integrated,
                    s2_place_i, s2_rgba_i, primary_area, s2_depth_i,
                    column_i, row_i, average_i, plain, area, depth}),
        .out_valid_o(slot_valid), .out_ready_i(slot_ready),
        .out_data_o({slot_primary, slot_secondary, slot_eye, slot_primary_write, slot_secondary_write,
                     slot_average_alpha, slot_average_rgb,
                     slot_primary_place, slot_primary_rgba, slot_primary_area, slot_primary_depth,
                     slot_secondary_place, slot_average, slot_plain, slot_secondary_area,
                     slot_secondary_depth})
    );

    wire [RB-1:0] slot_secondary_rgba = {
        slot_average_alpha ? slot_average[RB-1:`SAM_RGB_BITS] : slot_plain[RB-1:`SAM_RGB_BITS],
        slot_average_rgb ? slot_average[`SAM_RGB_BITS-1:0] : slot_plain[`SAM_RGB_BITS-1:0]
    };

    wire           pixel_valid, pixel_ready, pixel_visible, colour_valid, colour_ready, colour_visible;
    wire [RB-1:0]  pixel_rgba;
    wire [AB-1:0]  pixel_area;
    wire [`SAM_RGB_BITS-1:0] pixel_background;
    wire [`SAM_RGB_BITS-1:0] colour_rgb;
    wire           out_valid, out_ready, out_primary, out_secondary, out_blended, out_eye;
    wire           out_primary_write, out_secondary_write;
    wire [C-1:0]   out_primary_x, out_primary_y, out_secondary_x, out_secondary_y;
    wire [RB-1:0]  out_primary_rgba, out_secondary_rgba;
    wire [AB-1:0]  out_primary_area, out_secondary_area;
    wire [D-1:0]   out_primary_depth, out_secondary_depth;

    sam_slot_queue #(
        .SUBPIXEL_BITS(SUBPIXEL_BITS), .ANTIALIAS(ANTIALIAS), .DEPTH_EXTERNAL(DEPTH_EXTERNAL),
        .SLOTS(SLOTS)
    ) u_slot_queue (
        .clk_i(clk_i), .rst_i(rst_i), .single_i(single_i),
        .next_eye_i(~s2_eye_i), .next_x_i(column_i), .next_y_i(row_i),
        .slot_valid_i(slot_valid), .slot_ready_o(slot_ready),
        .slot_primary_i(slot_primary), .slot_secondary_i(slot_secondary), .slot_eye_i(slot_eye),
        .slot_primary_x_i(slot_primary_place[C +: C]), .slot_primary_y_i(slot_primary_place[0 +: C]),
        .slot_primary_rgba_i(slot_primary_rgba), .slot_primary_area_i(slot_primary_area),
        .slot_primary_depth_i(slot_primary_depth), .slot_primary_write_i(slot_primary_write),
        .slot_secondary_x_i(slot_secondary_place[C +: C]),
        .slot_secondary_y_i(slot_secondary_place[0 +: C]),
        .slot_secondary_rgba_i(slot_secondary_rgba), .slot_secondary_area_i(slot_secondary_area),
        .slot_secondary_depth_i(slot_secondary_depth),
        .slot_secondary_write_i(slot_secondary_write),
        .request_valid_o(request_valid_o), .request_ready_i(request_ready_i),
        .request_eye_o(request_eye_o), .request_x_o(request_x_o), .request_y_o(request_y_o),
        .response_valid_i(response_valid_i), .response_ready_o(response_ready_o),
        .response_rgb_i(response_rgb_i), .response_depth_i(response_depth_i),
        .pixel_valid_o(pixel_valid), .pixel_ready_i(pixel_ready), .pixel_rgba_o(pixel_rgba),
        .pixel_area_o(pixel_area), .pixel_background_o(pixel_background),
        .pixel_visible_o(pixel_visible),
        .colour_valid_i(colour_valid), .colour_ready_o(colour_ready), .colour_rgb_i(colour_rgb),
        .colour_visible_i(colour_visible),
        .out_valid_o(out_valid), .out_ready_i(out_ready), .out_primary_o(out_primary),
        .out_secondary_o(out_secondary), .out_blended_o(out_blended), .out_eye_o(out_eye),
        .out_primary_x_o(out_primary_x), .out_primary_y_o(out_primary_y),
        .out_primary_rgba_o(out_primary_rgba), .out_primary_area_o(out_primary_area),
        .out_primary_depth_o(out_primary_depth), .out_primary_write_o(out_primary_write),
        .out_secondary_x_o(out_secondary_x), .out_secondary_y_o(out_secondary_y),
        .out_secondary_rgba_o(out_secondary_rgba), .out_secondary_area_o(out_secondary_area),
        .out_secondary_depth_o(out_secondary_depth), .out_secondary_write_o(out_secondary_write)
    );

    sam_blend #(.ANTIALIAS(ANTIALIAS), .TAG_BITS(1)) u_blend (
        .clk_i(clk_i), .rst_i(rst_i),
        .pixel_valid_i(pixel_valid), .pixel_ready_o(pixel_ready),
        .pixel_rgb_i(pixel_rgba[`SAM_RGB_BITS-1:0]), .pixel_alpha_i(pixel_rgba[RB-1:`SAM_RGB_BITS]),
        .pixel_area_i(pixel_area), .pixel_background_i(pixel_background), .pixel_tag_i(pixel_visible),
        .colour_valid_o(colour_valid), .colour_ready_i(colour_ready),
        .colour_rgb_o(colour_rgb), .colour_tag_o(colour_visible)
    );

    sam_redirect #(.SUBPIXEL_BITS(SUBPIXEL_BITS), .ANTIALIAS(ANTIALIAS)) u_redirect (
        .clk_i(clk_i), .rst_i(rst_i), .single_i(single_i),
        .slot_valid_i(out_valid), .slot_ready_o(out_ready),
        .slot_primary_i(out_primary), .slot_secondary_i(out_secondary), .slot_eye_i(out_eye),
        .slot_primary_x_i(out_primary_x), .slot_primary_y_i(out_primary_y),
        .slot_primary_rgba_i(out_primary_rgba), .slot_primary_area_i(out_primary_area),
        .slot_primary_depth_i(out_primary_depth), .slot_primary_write_i(out_primary_write),
        .slot_secondary_x_i(out_secondary_x), .slot_secondary_y_i(out_secondary_y),
        .slot_secondary_rgba_i(out_secondary_rgba), .slot_secondary_area_i(out_secondary_area),
        .slot_secondary_depth_i(out_secondary_depth), .slot_secondary_write_i(out_secondary_write),
        .slot_secondary_blended_i(out_blended),
        .left_valid_o(left_valid_o), .left_ready_i(left_ready_i), .left_eye_o(left_eye_o),
        .left_x_o(left_x_o), .left_y_o(left_y_o), .left_rgba_o(left_rgba_o),
        .left_area_o(left_area_o), .left_depth_o(left_depth_o), .left_write_o(left_write_o),
        .left_blended_o(left_blended_o),
        .right_valid_o(right_valid_o), .right_ready_i(right_ready_i), .right_eye_o(right_eye_o),
        .right_x_o(right_x_o), .right_y_o(right_y_o), .right_rgba_o(right_rgba_o),
        .right_area_o(right_area_o), .right_depth_o(right_depth_o), .right_write_o(right_write_o),
        .right_blended_o(right_blended_o)
    );

    wire unused = &{1'b0, edges_ready, coverage_valid};

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

    wire f_take = s2_valid_i & s3_ready_o;
    // Beats that can draw, and pixels that were drawn.
    reg [4:0] f_ins, f_seconds, f_asked, f_outs;
    always @(posedge clk_i) begin
        f_ins     <= rst_i ? 0 : f_ins + (f_take & (s2_draw_i | s2_secondary_i));
        f_seconds <= rst_i ? 0 : f_seconds + (f_take & s2_secondary_i);
        f_asked   <= rst_i ? 0 : f_asked + (request_valid_o & request_ready_i);
        f_outs    <= rst_i ? 0 : f_outs + (left_valid_o & left_ready_i) + (right_valid_o & right_ready_i);
        assume (~f_begun | $stable(single_i));
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
        // A beat gives two pixels at most.
        p_nothing_made: assert (f_outs <= 2 * f_ins);
        // Only a secondary pixel is read for, and once: no more reads than there were beats with one.
        p_reads: assert (f_asked <= f_seconds);
    end
`endif
endmodule

`default_nettype wire
