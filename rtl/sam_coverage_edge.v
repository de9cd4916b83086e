// Which of a pixel's 16 samples one edge covers. Combinational.
// Paper: section 5.4.
`include "sam_formats.vh"
`default_nettype none

module sam_coverage_edge #(
    // Fraction bits of a snapped vertex, sets the widths of an edge: 4 or 8.
    parameter SUBPIXEL_BITS = 8
) (
    input  wire [`SAM_EDGE_BITS(SUBPIXEL_BITS)-1:0]  value_i,
    input  wire [`SAM_SLOPE_BITS(SUBPIXEL_BITS)-1:0] a_i,
    input  wire [`SAM_SLOPE_BITS(SUBPIXEL_BITS)-1:0] b_i,
    input  wire [`SAM_LOW_BITS-1:0]                  low_i,
    output wire [15:0]                               mask_o
);
    localparam E = `SAM_EDGE_BITS(SUBPIXEL_BITS) + `SAM_LOW_BITS;
    localparam S = `SAM_SLOPE_BITS(SUBPIXEL_BITS);
    localparam W = S + 3;

    generate
        if (SUBPIXEL_BITS != 4 && SUBPIXEL_BITS != 8) begin : g_illegal
            sam_coverage_edge_SUBPIXEL_BITS_must_be_4_or_8 u_error ();
        end
    endgenerate

    // No sample differs from the centre by more than 6 * 2^(S-1), so that many bits are enough:
    // a value that does not fit is replaced by one with its sign that is at least as large.
    wire [E-1:0]        full    = {value_i, low_i};
    wire                sign    = full[E-1];
    wire                huge   = sign ? ~&full[E-2:W-1] : |full[E-2:W-1];
    wire signed [W-1:0] centre  = {sign, huge ? {2{~sign}} : full[W-2:W-3], full[W-4:0]};

    wire signed [W-1:0] a    = {{3{a_i[S-1]}}, a_i};
    wire signed [W-1:0] b    = {{3{b_i[S-1]}}, b_i};
    wire signed [W-1:0] plus = a + b;
    wire signed [W-1:0] less = a - b;

    // Sample (k, l) is at centre + (2k-3) a + (2l-3) b = (centre - a - b) + 2 (k-1) a + 2 (l-1) b:
    // only half of it matters for the sign. `here` is that half at sample (1, 1), `below` at
    // (1, 2); every other sample is one addition away from one of the two, of which only the sign
    // is needed. Two full sums and 14 signs are fewer gates than four sums and 12 signs.
    wire signed [W-1:0] here;
    wire signed [W-1:0] below = here + b;
    wire                odd;
    assign {here, odd} = {centre[W-1], centre} - {plus[W-1], plus};

    wire signed [W-1:0] sample_0  = here - plus;
    wire signed [W-1:0] sample_1  = here - b;
    wire signed [W-1:0] sample_2  = here + less;
    wire signed [W-1:0] sample_3  = below + {less[W-2:0], 1'b0};
    wire signed [W-1:0] sample_4  = here - a;
    wire signed [W-1:0] sample_6  = here + a;
    wire signed [W-1:0] sample_7  = here + {a[W-2:0], 1'b0};
    wire signed [W-1:0] sample_8  = here - less;
    wire signed [W-1:0] sample_10 = here + plus;
    wire signed [W-1:0] sample_11 = below + {a[W-2:0], 1'b0};
    wire signed [W-1:0] sample_12 = below - less;
    wire signed [W-1:0] sample_13 = here + {b[W-2:0], 1'b0};
    wire signed [W-1:0] sample_14 = below + plus;
    wire signed [W-1:0] sample_15 = here + {plus[W-2:0], 1'b0};

    assign mask_o = ~{
        sample_15[W-1], sample_14[W-1], sample_13[W-1], sample_12[W-1],
        sample_11[W-1], sample_10[W-1], below[W-1], sample_8[W-1],
        sample_7[W-1], sample_6[W-1], here[W-1], sample_4[W-1],
        sample_3[W-1], sample_2[W-1], sample_1[W-1], sample_0[W-1]
    };

    wire unused = &{
        1'b0, odd, sample_0[W-2:0], sample_1[W-2:0], sample_2[W-2:0], sample_3[W-2:0],
        sample_4[W-2:0], sample_6[W-2:0], sample_7[W-2:0], sample_8[W-2:0], sample_10[W-2:0],
        sample_11[W-2:0], sample_12[W-2:0], sample_13[W-2:0], sample_14[W-2:0], sample_15[W-2:0]
    };

`ifdef FORMAL
    // The samples by their definition, in more bits than any of them needs.
    localparam V = E + 4;
    wire signed [V-1:0] f_value = $signed({value_i, low_i});
    wire signed [V-1:0] f_a = $signed(a_i);
    wire signed [V-1:0] f_b = $signed(b_i);
    // It is (8 E + low - a - b) + 2 ((k - 1) a + (l - 1) b), of which half, rounded down, has the sign.
    wire signed [V-1:0] f_here = (f_value - f_a - f_b) >>> 1;
    wire [15:0] f_mask;
    genvar f_k;
    generate
        for (f_k = 0; f_k < 16; f_k = f_k + 1) begin : g_f_sample
            wire signed [V-1:0] f_half = f_here + (f_k % 4 - 1) * f_a + (f_k / 4 - 1) * f_b;
            assign f_mask[f_k] = f_half >= 0;
        end
    endgenerate
    always @* begin
        // Sample k + 4 l is covered where 8 E + low + (2k - 3) a + (2l - 3) b is not negative.
        p_samples: assert (mask_o == f_mask);
    end
`endif
endmodule

`default_nettype wire
