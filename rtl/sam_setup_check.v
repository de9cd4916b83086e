// Whether a polygon's setup is one that the pipelines can draw. Combinational.
// Paper: sections 4 and 5.6.1 (which polygons may be derived), 5.3 (lent edges).
`include "sam_formats.vh"
`default_nettype none

module sam_setup_check #(
    // Fraction bits of a snapped vertex, sets the guard band: 4 or 8.
    parameter SUBPIXEL_BITS = 8
) (
    input  wire [`SAM_MODE_BITS-1:0]                   setup_mode_i,
    input  wire                                        setup_lend_i,
    input  wire [`SAM_PIXEL_X_BITS(SUBPIXEL_BITS)-1:0] setup_x_start_i, // whole pixels
    input  wire [`SAM_SCALE_BITS-1:0]                  setup_x_step_i,
    output wire                                        bad_o
);
    localparam P = `SAM_PIXEL_X_BITS(SUBPIXEL_BITS);

    // Before the first and after the last pixel in which a start is accepted.
    localparam integer BEFORE = `SAM_GUARD_BAND(SUBPIXEL_BITS) + `SAM_START_SLACK;
    localparam integer AFTER  = `SAM_MAX_SIZE(SUBPIXEL_BITS) + BEFORE;

    generate
        if (SUBPIXEL_BITS != 4 && SUBPIXEL_BITS != 8) begin : g_illegal
            sam_setup_check_SUBPIXEL_BITS_must_be_4_or_8 u_error ();
        end
    endgenerate

    wire binocular = setup_mode_i[1];
    wire unknown   = setup_mode_i > `SAM_MODE_RIGHT_TO_LEFT;
    wire scale_bad = (setup_x_step_i > `SAM_SCALE_ONE) | (setup_x_step_i < `SAM_SCALE_MIN);

    // Counted from the first accepted pixel, so that one comparison does: earlier pixels wrap
    // round to numbers above the range.
    wire [P-1:0] offset     = setup_x_start_i + BEFORE[P-1:0];
    wire         start_bad  = offset >= AFTER[P-1:0] + BEFORE[P-1:0];

    assign bad_o = unknown | (binocular & setup_lend_i) | (binocular & scale_bad)
                 | ((binocular | setup_lend_i) & start_bad);

`ifdef FORMAL
    // The conditions of section "Units" in ARCHITECTURE.md, in whole numbers.
    wire signed [15:0] f_x = $signed(setup_x_start_i);
    wire f_binocular = setup_mode_i == `SAM_MODE_LEFT_TO_RIGHT | setup_mode_i == `SAM_MODE_RIGHT_TO_LEFT;
    wire f_start_bad = f_x < -(`SAM_GUARD_BAND(SUBPIXEL_BITS) + `SAM_START_SLACK)
        | f_x >= `SAM_MAX_SIZE(SUBPIXEL_BITS) + `SAM_GUARD_BAND(SUBPIXEL_BITS) + `SAM_START_SLACK;
    always @* begin
        // A mode above 3 is bad.
        p_mode: assert (setup_mode_i < 4 | bad_o);
        // To lend the edges of a binocular polygon is bad.
        p_lend: assert (~f_binocular | ~setup_lend_i | bad_o);
        // G1 of a binocular polygon is bad above 1.0 and below 565.
        p_scale: assert (~f_binocular | (setup_x_step_i >= 565 & setup_x_step_i <= 1 << `SAM_FRACTION_BITS) | bad_o);
        // A start far outside is bad where the secondary x counts.
        p_start: assert (~f_start_bad | (~f_binocular & ~setup_lend_i) | bad_o);
        // Nothing else is bad.
        p_good: assert (~bad_o | setup_mode_i > 3 | (f_binocular & (setup_lend_i | setup_x_step_i < 565
            | setup_x_step_i > 1 << `SAM_FRACTION_BITS)) | ((f_binocular | setup_lend_i) & f_start_bad));
    end
`endif
endmodule

`default_nettype wire
