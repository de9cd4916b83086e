// Division of the filter's sum of one channel by n. Combinational.
// Paper: section 5.6.1, equation 1 and figure 6.
`include "sam_formats.vh"
`default_nettype none

module sam_filter_division #(
    // 2 or 3: 1/n as so many powers of two. 0: by a reciprocal, with the rounding in the sum.
    parameter FILTER_TERMS = 0
) (
    input  wire [12:0]                sum_i,
    input  wire [`SAM_COUNT_BITS-1:0] count_i,
    input  wire [17:0]                factor_i,
    output wire [7:0]                 quotient_o
);
    generate
        if (FILTER_TERMS != 0 && FILTER_TERMS != 2 && FILTER_TERMS != 3) begin : g_illegal
            sam_filter_division_FILTER_TERMS_must_be_0_or_2_or_3 u_error ();
        end
        if (FILTER_TERMS == 0) begin : g_exact
            wire [30:0] product = {18'd0, sum_i} * {13'd0, factor_i};
            assign quotient_o = product[`SAM_RECIPROCAL_SHIFT +: 8];
            wire unused = &{1'b0, count_i, product[30:26], product[17:0]};
        end else if (FILTER_TERMS == 2) begin : g_two_terms
            // sum (2^-p + 2^-q) is (sum + sum 2^-d) 2^-p with d = q - p: a short adder between two
            // short shifters. Bits below 2^-d cannot carry, as the other addend has none there.
            localparam [127:0] P = `SAM_TWO_TERM_P;
            localparam [127:0] Q = `SAM_TWO_TERM_Q;

            wire [3:0]  p      = P[{count_i, 2'b00} +: 4];
            wire [3:0]  d      = Q[{count_i, 2'b00} +: 4] - p;
            wire [12:0] second = sum_i >> d[2:0];
            wire [13:0] total  = {1'b0, sum_i} + {1'b0, second};
            // With one fraction bit, for the rounding.
            wire [14:0] scaled  = {total, 1'b0} >> p[2:0];
            wire [8:0]  rounded = scaled[9:1] + {8'd0, scaled[0]};

            assign quotient_o = rounded[7:0] | {8{rounded[8]}};
            wire unused = &{1'b0, scaled[14:10], p[3], d[3], factor_i};
        end else begin : g_three_terms
            localparam SHIFT = `SAM_THREE_TERM_SHIFT;
            localparam [127:0] P = `SAM_THREE_TERM_P;
            localparam [127:0] Q = `SAM_THREE_TERM_Q;
            localparam [127:0] R = `SAM_THREE_TERM_R;
            localparam T = 13 + SHIFT;

            // No exponent exceeds SHIFT: nothing is lost before the sum is rounded.
            wire [T-1:0] scaled = {sum_i, {SHIFT{1'b0}}};
            wire [T-1:0] total  = (scaled >> P[{count_i, 2'b00} +: 4])
                                + (scaled >> Q[{count_i, 2'b00} +: 4])
                                + (scaled >> R[{count_i, 2'b00} +: 4])
                                + {13'd0, 1'b1, {(SHIFT - 1){1'b0}}};
            assign quotient_o = total[SHIFT +: 8] | {8{total[SHIFT + 8]}};
            wire unused = &{1'b0, total[T-1:SHIFT+9], total[SHIFT-1:0], factor_i};
        end
    endgenerate

`ifdef FORMAL
    // By the formulae of ARCHITECTURE.md, in more bits than they need. The sum is that of so many
    // channels of 8 bits; of the exact division it has its rounding in it.
    localparam [127:0] F_P2 = `SAM_TWO_TERM_P,   F_Q2 = `SAM_TWO_TERM_Q;
    localparam [127:0] F_P3 = `SAM_THREE_TERM_P, F_Q3 = `SAM_THREE_TERM_Q, F_R3 = `SAM_THREE_TERM_R;
    wire [6:0]  f_at    = 4 * count_i;
    wire [31:0] f_sum   = sum_i;
    wire [31:0] f_two   = ((f_sum << (8 - F_P2[f_at +: 4])) + (f_sum << (8 - F_Q2[f_at +: 4])) + 128) >> 8;
    wire [31:0] f_three = ((f_sum << (11 - F_P3[f_at +: 4])) + (f_sum << (11 - F_Q3[f_at +: 4]))
                        + (f_sum << (11 - F_R3[f_at +: 4])) + 1024) >> 11;
    wire [31:0] f_most  = 255 * count_i + (FILTER_TERMS == 0 ? (count_i == 1 ? 1 : count_i / 2) : 0);
    wire        f_legal = count_i != 0 & count_i <= `SAM_FILTER_LIMIT & f_sum <= f_most
                        & (FILTER_TERMS != 0 | count_i != 1 | f_sum != 0);
    // The reciprocal that goes with the count, as the filter has it.
    localparam [32*`SAM_RECIPROCAL_BITS-1:0] F_RECIPROCAL = `SAM_RECIPROCAL;
    wire [17:0] f_factor = count_i == 1 ? 18'h3ffff : F_RECIPROCAL[count_i * `SAM_RECIPROCAL_BITS +: 18];
    wire [31:0] f_whole  = f_sum - (count_i == 1);
    always @* begin
        assume (FILTER_TERMS != 0 | factor_i == f_factor);
        // Two powers of two give the rounded formula, at most 255.
        p_two_terms: assert (FILTER_TERMS != 2 | ~f_legal | quotient_o == (f_two > 255 ? 255 : f_two));
        // So do three.
        p_three_terms: assert (FILTER_TERMS != 3 | ~f_legal | quotient_o == (f_three > 255 ? 255 : f_three));
        // The exact quotient is the whole part of the division and never above 255.
        p_exact: assert (FILTER_TERMS != 0 | ~f_legal
                         | (quotient_o * count_i <= f_whole & f_whole < (quotient_o + 32'd1) * count_i));
    end
`endif
endmodule

`default_nettype wire
