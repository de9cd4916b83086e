// What the beat in the first stage belongs to: the flags of its polygon, and whether it is void.
// A bad setup or an illegal beat makes all beats void until the next good LOAD.
//
// Latency: one clock, that of the coordinate interpolators.
// Reset: rst_i makes beats void, as no polygon is loaded; the flags keep what they had.
// Paper: section 4.
`include "sam_formats.vh"
`default_nettype none

module sam_polygon #(
    // Fraction bits of a snapped vertex, sets the guard band: 4 or 8.
    parameter SUBPIXEL_BITS = 8,
    // The edge interpolators can be lent to a monocular polygon: 0 or 1.
    parameter LEND = 1
) (
    input  wire                                        clk_i,
    input  wire                                        rst_i,

    input  wire                                        accept_i,
    input  wire [`SAM_OP_BITS-1:0]                     op_i,
    input  wire [`SAM_MODE_BITS-1:0]                   setup_mode_i,
    input  wire                                        setup_lend_i,
    input  wire                                        setup_average_i,
    input  wire                                        setup_planes_i,
    input  wire [`SAM_PIXEL_X_BITS(SUBPIXEL_BITS)-1:0] setup_x_start_i, // whole pixels
    input  wire [`SAM_SCALE_BITS-1:0]                  setup_x_step_i,
    input  wire                                        setup_swap_i,
    input  wire                                        setup_mirror_i,

    output reg                                         void_o,
    output reg                                         eye_o,
    output reg                                         binocular_o,
    output reg                                         lend_o,
    output reg                                         average_o,
    output reg                                         planes_o,
    output reg                                         swap_o,
    output reg                                         mirror_o
);
    generate
        if (SUBPIXEL_BITS != 4 && SUBPIXEL_BITS != 8) begin : g_illegal_subpixel_bits
            sam_polygon_SUBPIXEL_BITS_must_be_4_or_8 u_error ();
        end
        if (LEND != 0 && LEND != 1) begin : g_illegal_lend
            sam_polygon_LEND_must_be_0_or_1 u_error ();
        end
    endgenerate

    wire bad;

    sam_setup_check #(
        .SUBPIXEL_BITS(SUBPIXEL_BITS)
    ) u_setup_check (
        .setup_mode_i   (setup_mode_i),
        .setup_lend_i   (setup_lend_i),
        .setup_x_start_i(setup_x_start_i),
        .setup_x_step_i (setup_x_step_i),
        .bad_o          (bad)
    );

    wire is_load = op_i == `SAM_OP_LOAD;
    wire refuse  = bad | (setup_lend_i & (LEND == 0));

    always @(posedge clk_i) begin
        if (rst_i)                                         void_o <= 1'b1;
        else if (accept_i & is_load)                       void_o <= refuse;
        else if (accept_i & (op_i == `SAM_OP_RESERVED))    void_o <= 1'b1;

        if (accept_i & is_load) begin
            eye_o       <= setup_mode_i[0];
            binocular_o <= setup_mode_i[1];
            lend_o      <= setup_lend_i;
            average_o   <= setup_average_i;
            planes_o    <= setup_planes_i;
            swap_o      <= setup_swap_i;
            mirror_o    <= setup_mirror_i;
        end
    end

`ifdef FORMAL
`include "sam_formal.vh"
    `SAM_BEGIN
    wire [6:0] f_flags = {eye_o, binocular_o, lend_o, average_o, planes_o, swap_o, mirror_o};
    reg        f_loaded = 1'b0;
    reg  [6:0] f_of_load;
    wire       f_load = accept_i & op_i == `SAM_OP_LOAD;
    // A setup that no mode allows, whatever its x.
    wire f_illegal = setup_mode_i > 3 | (setup_mode_i[1] & setup_lend_i) | (setup_lend_i & LEND == 0)
                   | (setup_mode_i[1] & (setup_x_step_i < 565 | setup_x_step_i > 1 << `SAM_FRACTION_BITS));
    // One that every configuration draws.
    wire f_legal = setup_mode_i < 4 & ~setup_lend_i
                 & (~setup_mode_i[1] | (setup_x_start_i < 640 & setup_x_step_i >= 565 & setup_x_step_i <= 1 << `SAM_FRACTION_BITS));

    always @(posedge clk_i) if (f_load) begin
        f_loaded  <= 1'b1;
        f_of_load <= {setup_mode_i[0], setup_mode_i[1], setup_lend_i, setup_average_i, setup_planes_i,
                      setup_swap_i, setup_mirror_i};
    end

    always @(posedge clk_i) if (f_begun) begin
        // After a reset beats are void.
        p_after_reset: assert (~$past(rst_i) | void_o);
        // They are not where a good LOAD was last,
        p_good: assert ($past(rst_i | ~f_load | ~f_legal) | ~void_o);
        // they are where a bad one was,
        p_bad: assert ($past(rst_i | ~f_load | ~f_illegal) | void_o);
        // and after a beat with the reserved op.
        p_reserved: assert ($past(rst_i | ~accept_i) | $past(op_i) != `SAM_OP_RESERVED | void_o);
        // Nothing else changes that.
        p_holds: assert ($past(rst_i | (accept_i & op_i != `SAM_OP_STEP & op_i != `SAM_OP_ROW)) | $stable(void_o));
        // The flags are those of the last LOAD.
        p_flags: assert (~f_loaded | f_flags == f_of_load);
    end
`endif
endmodule

`default_nettype wire
