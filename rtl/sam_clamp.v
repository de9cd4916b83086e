// Integer part of an interpolated value, which may have run past the ends of its range where the
// polygon is extrapolated. Combinational.
// Paper: section 5.5.
`include "sam_formats.vh"
`default_nettype none

module sam_clamp #(
    // Bits of the result: 1 or more. The value has guard bits above and its fraction below.
    parameter BITS = 8
) (
    input  wire [BITS+`SAM_GUARD_BITS+`SAM_FRACTION_BITS-1:0] value_i,
    output wire [BITS-1:0] clamped_o
);
    localparam F = `SAM_FRACTION_BITS;

    generate
        if (BITS < 1) begin : g_illegal
            sam_clamp_BITS_must_be_1_or_more u_error ();
        end
    endgenerate

    localparam G = `SAM_GUARD_BITS;

    wire negative = value_i[F+BITS+G-1];
    wire above    = |value_i[F+BITS +: G-1];

    assign clamped_o = (value_i[F +: BITS] | {BITS{above}}) & {BITS{~negative}};

    wire unused = &{1'b0, value_i[F-1:0]};

`ifdef FORMAL
    // The floor of the value, as wide as it can be.
    wire signed [BITS+G-1:0] f_floor = $signed(value_i) >>> F;
    always @* begin
        // A value within the range is its floor.
        p_floor: assert (f_floor < 0 | f_floor >= (1 << BITS) | clamped_o == f_floor);
        // One below becomes 0.
        p_below: assert (f_floor >= 0 | clamped_o == 0);
        // One above becomes the largest number.
        p_above: assert (f_floor < (1 << BITS) | clamped_o == {BITS{1'b1}});
    end
`endif
endmodule

`default_nettype wire
