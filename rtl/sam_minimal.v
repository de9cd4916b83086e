// Minimal system: pure derivation by the spatial mapping, with point sampling. Its edges are those
// that the mapping happens to give.
//
//   setup, beat -> x and y interpolator -> display, sampler -> redirect -> left, right
//
// Latency: two clocks, the first of which waits for the next beat (or `last`).
// Reset: rst_i clears the stages' valids, redirect's notes and the error, and makes beats void
// until a LOAD; no data is reset.
// Paper: section 5, figure 3.
`include "sam_formats.vh"
`default_nettype none

module sam_minimal #(
    // Fraction bits of a snapped vertex, sets the width of every coordinate: 4 or 8.
    parameter SUBPIXEL_BITS = 8,
    // 16 coverage samples a pixel instead of one: 0 or 1.
    parameter ANTIALIAS = 0,
    // Secondary y affine in both directions: 0 or 1.
    parameter TILT = 0
) (
    input  wire                                           clk_i,
    input  wire                                           rst_i,
    input  wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] width_i,
    input  wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] height_i,
    input  wire                                           single_i,
    input  wire                                           error_clear_i,
    output wire                                           error_o,

    input  wire                                           setup_valid_i,
    output wire                                           setup_ready_o,
    input  wire [`SAM_MODE_BITS-1:0]                      setup_mode_i,
    input  wire                                           setup_lend_i,
    input  wire                                           setup_average_i,
    input  wire                                           setup_planes_i,
    input  wire [`SAM_X_BITS(SUBPIXEL_BITS)-1:0]          setup_x_start_i,
    input  wire [`SAM_SCALE_BITS-1:0]                     setup_x_step_i,
    input  wire [`SAM_X_BITS(SUBPIXEL_BITS)-1:0]          setup_x_row_i,
    input  wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] setup_y_start_i,
    input  wire [`SAM_DISPLAY_STEP_BITS-1:0]              setup_y_step_i,
    input  wire                                           setup_swap_i,
    input  wire                                           setup_mirror_i,
    input  wire [`SAM_X_BITS(SUBPIXEL_BITS)-1:0]          setup_y_view_i,
    input  wire [`SAM_SLANT_BITS-1:0]                     setup_y_slant_i,
    input  wire [`SAM_X_BITS(SUBPIXEL_BITS)-1:0]          setup_y_row_i,

    input  wire                                           beat_valid_i,
    output wire                                           beat_ready_o,
    input  wire [`SAM_OP_BITS-1:0]                        beat_op_i,
    input  wire                                           beat_save_i,
    input  wire                                           beat_last_i,
    input  wire                                           beat_centre_i,
    input  wire [`SAM_MASK_BITS(ANTIALIAS)-1:0]           beat_mask_i,
    input  wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] beat_x_i,
    input  wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] beat_y_i,
    input  wire [`SAM_RGBA_BITS-1:0]                      beat_rgba_i,
    input  wire [`SAM_DEPTH_BITS-1:0]                     beat_depth_i,

    output wire                                           left_valid_o,
    input  wire                                           left_ready_i,
    output wire                                           left_eye_o,
    output wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] left_x_o,
    output wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] left_y_o,
    output wire [`SAM_RGBA_BITS-1:0]                      left_rgba_o,
    output wire [`SAM_AREA_BITS(ANTIALIAS)-1:0]           left_area_o,
    output wire [`SAM_DEPTH_BITS-1:0]                     left_depth_o,
    output wire                                           left_write_o,
    output wire                                           left_blended_o,

    output wire                                           right_valid_o,
    input  wire                                           right_ready_i,
    output wire                                           right_eye_o,
    output wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] right_x_o,
    output wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] right_y_o,
    output wire [`SAM_RGBA_BITS-1:0]                      right_rgba_o,
    output wire [`SAM_AREA_BITS(ANTIALIAS)-1:0]           right_area_o,
    output wire [`SAM_DEPTH_BITS-1:0]                     right_depth_o,
    output wire                                           right_write_o,
    output wire                                           right_blended_o
);
    localparam C = `SAM_COORDINATE_BITS(SUBPIXEL_BITS);
    localparam P = `SAM_PIXEL_X_BITS(SUBPIXEL_BITS);
    localparam A = `SAM_AREA_BITS(ANTIALIAS);
    localparam D = `SAM_DEPTH_BITS;
    localparam integer FULL_AREA = `SAM_FULL_AREA(ANTIALIAS);

    generate
        if (SUBPIXEL_BITS != 4 && SUBPIXEL_BITS != 8) begin : g_illegal_subpixel_bits
            sam_minimal_SUBPIXEL_BITS_must_be_4_or_8 u_error ();
        end
        if (ANTIALIAS != 0 && ANTIALIAS != 1) begin : g_illegal_antialias
            sam_minimal_ANTIALIAS_must_be_0_or_1 u_error ();
        end
        if (TILT != 0 && TILT != 1) begin : g_illegal_tilt
            sam_minimal_TILT_must_be_0_or_1 u_error ();
        end
    endgenerate

    // First stage: where the beat falls in the secondary. A LOAD beat is offered with its setup.
    wire is_load = beat_op_i == `SAM_OP_LOAD;
    wire offered = beat_valid_i & (~is_load | setup_valid_i);
    wire s1_ready, s1_valid, s2_ready;

    assign beat_ready_o  = s1_ready & ~(beat_valid_i & ~offered);
    assign setup_ready_o = s1_ready & beat_valid_i & is_load;

    wire [`SAM_OP_BITS-1:0]   s1_op;
    wire [P-1:0]              s1_column;
    wire [C-1:0]              s1_row;
    wire [`SAM_MOVE_BITS-1:0] s1_row_move;
    wire s1_save, s1_last, s1_move, s1_near, s1_x_inside, s1_x_end, s1_y_inside, s1_y_end;
    wire y_ready, y_valid;

    sam_x_interpolator #(
        .SUBPIXEL_BITS(SUBPIXEL_BITS)
    ) u_x_interpolator (
        .clk_i(clk_i), .rst_i(rst_i), .width_i(width_i),
        .beat_valid_i(offered), .beat_ready_o(s1_ready),
        .beat_op_i(beat_op_i), .beat_save_i(beat_save_i), .beat_last_i(beat_last_i),
        .beat_start_i(setup_x_start_i), .beat_step_i(setup_x_step_i), .beat_row_i(setup_x_row_i),
        .pixel_valid_o(s1_valid), .pixel_ready_i(s2_ready),
        .pixel_op_o(s1_op), .pixel_save_o(s1_save), .pixel_last_o(s1_last),
        .pixel_x_o(s1_column), .pixel_move_o(s1_move), .pixel_near_o(s1_near),
        .pixel_inside_o(s1_x_inside), .pixel_end_o(s1_x_end)
    );

    sam_y_interpolator #(
        .SUBPIXEL_BITS(SUBPIXEL_BITS), .TILT(TILT)
    ) u_y_interpolator (
        .clk_i(clk_i), .rst_i(rst_i), .height_i(height_i),
        .beat_valid_i(offered), .beat_ready_o(y_ready),
        .beat_op_i(beat_op_i), .beat_save_i(beat_save_i), .beat_last_i(beat_last_i),
        .beat_start_i(setup_y_start_i), .beat_step_i(setup_y_step_i), .beat_view_i(setup_y_view_i),
        .beat_slant_i(setup_y_slant_i), .beat_row_i(setup_y_row_i),
        .pixel_valid_o(y_valid), .pixel_ready_i(s2_ready),
        .pixel_y_o(s1_row), .pixel_move_o(s1_row_move),
        .pixel_inside_o(s1_y_inside), .pixel_end_o(s1_y_end)
    );

    wire s1_void, s1_eye, s1_binocular, s1_lend, s1_average, s1_planes, s1_swap, s1_mirror;

    sam_polygon #(
        .SUBPIXEL_BITS(SUBPIXEL_BITS), .LEND(0)
    ) u_polygon (
        .clk_i(clk_i), .rst_i(rst_i), .accept_i(offered & s1_ready), .op_i(beat_op_i),
        .setup_mode_i(setup_mode_i), .setup_lend_i(setup_lend_i),
        .setup_average_i(setup_average_i), .setup_planes_i(setup_planes_i),
        .setup_x_start_i(setup_x_start_i[`SAM_FRACTION_BITS +: P]),
        .setup_x_step_i(setup_x_step_i), .setup_swap_i(setup_swap_i),
        .setup_mirror_i(setup_mirror_i),
        .void_o(s1_void), .eye_o(s1_eye), .binocular_o(s1_binocular), .lend_o(s1_lend),
        .average_o(s1_average), .planes_o(s1_planes), .swap_o(s1_swap), .mirror_o(s1_mirror)
    );

    // The area is all that is needed of the mask, and has fewer bits.
    wire [A-1:0] beat_area;

    sam_popcount #(.ANTIALIAS(ANTIALIAS)) u_area (.mask_i(beat_mask_i), .area_o(beat_area));

    reg                      s1_centre_q;
    reg [A-1:0]              s1_area_q;
    reg [C-1:0]              s1_x_q;
    reg [C-1:0]              s1_y_q;
    reg [`SAM_RGBA_BITS-1:0] s1_rgba_q;
    reg [D-1:0]              s1_depth_q;

    always @(posedge clk_i) begin
        if (offered & s1_ready) begin
            s1_centre_q <= beat_centre_i;
            s1_area_q   <= beat_area;
            s1_x_q      <= beat_x_i;
            s1_y_q      <= beat_y_i;
            s1_rgba_q   <= beat_rgba_i;
            s1_depth_q  <= beat_depth_i;
        end
    end

    wire s1_first  = (s1_op != `SAM_OP_STEP) | s1_move | (s1_row_move != {`SAM_MOVE_BITS{1'b0}});
    wire s1_end    = s1_x_end | s1_y_end;
    wire s1_inside = s1_x_inside & s1_y_inside;

    // Second stage: the primary pixel beside the derived one. All its units move together, so one
    // handshake serves them.
    wire         s2_valid, s2_eye, s2_primary, s2_wanted, s2_write, slot_ready;
    wire [A-1:0] s2_area;
    wire [C-1:0] s2_x, s2_y, column, row;
    wire [D-1:0] s2_depth, sample_depth;
    wire [`SAM_RGBA_BITS-1:0] s2_rgba, sample_rgba;

    sam_stage #(
        .WIDTH(4 + A + 2 * C + `SAM_RGBA_BITS + D)
    ) u_primary (
        .clk_i(clk_i), .rst_i(rst_i),
        .in_valid_i(s1_valid), .in_ready_o(s2_ready),
        .in_data_i({s1_eye, ~s1_void & (s1_area_q != {A{1'b0}}),
                    ~s1_void & s1_binocular & s1_end & s1_inside, s1_centre_q,
                    s1_area_q, s1_x_q, s1_y_q, s1_rgba_q, s1_depth_q}),
        .out_valid_o(s2_valid), .out_ready_i(slot_ready),
        .out_data_o({s2_eye, s2_primary, s2_wanted, s2_write,
                     s2_area, s2_x, s2_y, s2_rgba, s2_depth})
    );

    wire display_ready, display_valid, sampler_ready, sampler_valid, hit;

    sam_display #(
        .SUBPIXEL_BITS(SUBPIXEL_BITS)
    ) u_display (
        .clk_i(clk_i), .rst_i(rst_i), .width_i(width_i),
        .point_valid_i(s1_valid), .point_ready_o(display_ready),
        .point_x_i(s1_column), .point_y_i(s1_row),
        .point_swap_i(s1_swap), .point_mirror_i(s1_mirror),
        .pixel_valid_o(display_valid), .pixel_ready_i(slot_ready),
        .pixel_x_o(column), .pixel_y_o(row)
    );

    // Its register is free between the ends of pixels, when the stage may be stalled all the same.
    sam_sampler #(
        .WIDTH(`SAM_RGBA_BITS + D)
    ) u_sampler (
        .clk_i(clk_i), .rst_i(rst_i),
        .beat_valid_i(s1_valid & s2_ready), .beat_ready_o(sampler_ready),
        .beat_first_i(s1_first), .beat_end_i(s1_end), .beat_near_i(s1_near),
        .beat_take_i(s1_centre_q), .beat_data_i({s1_depth_q, s1_rgba_q}),
        .sample_valid_o(sampler_valid), .sample_ready_i(slot_ready),
        .sample_data_o({sample_depth, sample_rgba}), .sample_hit_o(hit)
    );

    wire s2_secondary = s2_wanted & hit;

    sam_redirect #(
        .SUBPIXEL_BITS(SUBPIXEL_BITS), .ANTIALIAS(ANTIALIAS)
    ) u_redirect (
        .clk_i(clk_i), .rst_i(rst_i), .single_i(single_i),
        .slot_valid_i(s2_valid & (s2_primary | s2_secondary)), .slot_ready_o(slot_ready),
        .slot_primary_i(s2_primary), .slot_secondary_i(s2_secondary), .slot_eye_i(s2_eye),
        .slot_primary_x_i(s2_x), .slot_primary_y_i(s2_y), .slot_primary_rgba_i(s2_rgba),
        .slot_primary_area_i(s2_area), .slot_primary_depth_i(s2_depth),
        .slot_primary_write_i(s2_write),
        .slot_secondary_x_i(column), .slot_secondary_y_i(row),
        .slot_secondary_rgba_i(sample_rgba), .slot_secondary_area_i(FULL_AREA[A-1:0]),
        .slot_secondary_depth_i(sample_depth), .slot_secondary_write_i(1'b1),
        .slot_secondary_blended_i(1'b0),
        .left_valid_o(left_valid_o), .left_ready_i(left_ready_i), .left_eye_o(left_eye_o),
        .left_x_o(left_x_o), .left_y_o(left_y_o), .left_rgba_o(left_rgba_o),
        .left_area_o(left_area_o), .left_depth_o(left_depth_o), .left_write_o(left_write_o),
        .left_blended_o(left_blended_o),
        .right_valid_o(right_valid_o), .right_ready_i(right_ready_i), .right_eye_o(right_eye_o),
        .right_x_o(right_x_o), .right_y_o(right_y_o), .right_rgba_o(right_rgba_o),
        .right_area_o(right_area_o), .right_depth_o(right_depth_o), .right_write_o(right_write_o),
        .right_blended_o(right_blended_o)
    );

    reg error_q;

    always @(posedge clk_i) begin
        if (rst_i) error_q <= 1'b0;
        else       error_q <= (error_q & ~error_clear_i) | (s1_valid & s2_ready & s1_void);
    end

    assign error_o = error_q;

    wire unused = &{
        1'b0, y_ready, y_valid, s1_save, s1_last, s1_lend, s1_average, s1_planes,
        display_ready, display_valid, sampler_ready, sampler_valid
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
    // The beat that was taken last is of such a polygon, and the error was not cleared since.
    reg  f_due;
    wire f_bad_beat = f_load ? f_illegal : f_bad;
    always @(posedge clk_i) begin
        f_void <= rst_i | (f_void & ~f_starts);
        f_bad  <= rst_i | f_bad_beat;
        f_due  <= ~rst_i & (f_take ? f_bad_beat : f_due & ~error_clear_i);
        assume (`SAM_WAITS(beat_valid_i, beat_ready_o, {beat_op_i, beat_save_i, beat_last_i, beat_centre_i,
                           beat_mask_i, beat_x_i, beat_y_i, beat_rgba_i, beat_depth_i}));
        assume (`SAM_WAITS(setup_valid_i, setup_ready_o, {setup_mode_i, setup_lend_i, setup_average_i,
            setup_planes_i, setup_x_start_i, setup_x_step_i, setup_x_row_i, setup_y_start_i, setup_y_step_i,
            setup_swap_i, setup_mirror_i, setup_y_view_i, setup_y_slant_i, setup_y_row_i}));
        assume (~f_begun | $stable({width_i, height_i, single_i}));
    end

    // Clocks that a beat has waited with everything ready round it.
    reg [2:0] f_waited;
    wire f_eager = left_ready_i & right_ready_i & beat_valid_i & (setup_valid_i | beat_op_i != `SAM_OP_LOAD);
    always @(posedge clk_i) f_waited <= rst_i | ~f_eager | beat_ready_o ? 0 : f_waited + 1;
    // Beats and pixels, and whether there were any of one colour, whichever.
    wire [31:0] f_rgba = $anyconst;
    wire f_left  = left_valid_o & left_ready_i;
    wire f_right = right_valid_o & right_ready_i;
    reg  [4:0] f_ins, f_outs;
    reg        f_coloured;
    always @(posedge clk_i) begin
        f_ins      <= rst_i ? 0 : f_ins + f_take;
        f_outs     <= rst_i ? 0 : f_outs + f_left + f_right;
        f_coloured <= f_coloured | (f_take & beat_rgba_i == f_rgba);
    end
    reg [3:0] f_loads;
    always @(posedge clk_i) f_loads <= rst_i ? 0 : f_loads + (f_take & beat_op_i == `SAM_OP_LOAD) - f_setup;

    always @(posedge clk_i) if (f_begun) begin
        // A pixel that waits on the left is offered again, unchanged,
        p_left_stable: assert (`SAM_WAITS(left_valid_o, left_ready_i,
            {left_eye_o, left_x_o, left_y_o, left_rgba_o, left_area_o, left_depth_o, left_write_o, left_blended_o}));
        // and so is one on the right.
        p_right_stable: assert (`SAM_WAITS(right_valid_o, right_ready_i,
            {right_eye_o, right_x_o, right_y_o, right_rgba_o, right_area_o, right_depth_o, right_write_o, right_blended_o}));
        // With two streams each has the pixels of its eye, with one the right is silent.
        p_eyes: assert (single_i ? ~right_valid_o : (~left_valid_o | ~left_eye_o) & (~right_valid_o | right_eye_o));
        // A setup is taken with its LOAD, and with nothing else.
        p_setup: assert (f_setup == (f_take & beat_op_i == `SAM_OP_LOAD));
        // Where all is ready a beat waits for a clock at most, two on one display, whatever the setup was:
        // nothing hangs.
        p_never_hangs: assert (rst_i | f_waited <= 1 + single_i);
        // Before a good setup nothing is drawn.
        p_void: assert (~f_void | (~left_valid_o & ~right_valid_o));
        // The error is raised by a void beat only,
        p_error: assert ($past(rst_i) | ~error_o | $past(error_o) | $past(f_void) | $past(s1_void));
        // is up at the latest when the beat after a bad one has been taken, unless cleared meanwhile,
        p_error_rises: assert ($past(rst_i | ~f_take | ~f_due | error_clear_i) | error_o);
        // and stays until it is cleared.
        p_error_stays: assert ($past(rst_i | ~error_o | error_clear_i) | error_o);
        // A beat gives two pixels at most, a primary and a secondary.
        p_nothing_made: assert (f_outs <= 2 * f_ins);
        // A colour that is drawn has come with a beat.
        p_colour: assert (f_coloured | ((~left_valid_o | left_rgba_o != f_rgba) & (~right_valid_o | right_rgba_o != f_rgba)));
        // Lemma: void beats stay so in both stages.
        lemma: assert (~f_void | (s1_void & (~s2_valid | (~s2_primary & ~s2_wanted))));
        // A pixel that can be blended later says so.
        p_unblended: assert (~left_blended_o & ~right_blended_o);
    end
`endif
endmodule

`default_nettype wire
