// Pixel coverage: the samples inside all three edges of the secondary polygon, and their number.
//
// Latency: none. The hybrid system registers the pixel that this is the coverage of.
// Reset: nothing to reset.
// Paper: section 5.4.
`include "sam_formats.vh"
`default_nettype none

module sam_coverage #(
    // Fraction bits of a snapped vertex, sets the widths of an edge: 4 or 8.
    parameter SUBPIXEL_BITS = 8,
    // 16 coverage samples a pixel instead of one: 0 or 1.
    parameter ANTIALIAS = 0
) (
    input  wire                                      clk_i,
    input  wire                                      rst_i,

    input  wire                                      edges_valid_i,
    output wire                                      edges_ready_o,
    input  wire [`SAM_EDGE_BITS(SUBPIXEL_BITS)-1:0]  edges_value0_i,
    input  wire [`SAM_SLOPE_BITS(SUBPIXEL_BITS)-1:0] edges_a0_i,
    input  wire [`SAM_SLOPE_BITS(SUBPIXEL_BITS)-1:0] edges_b0_i,
    input  wire [`SAM_LOW_BITS-1:0]                  edges_low0_i,
    input  wire [`SAM_EDGE_BITS(SUBPIXEL_BITS)-1:0]  edges_value1_i,
    input  wire [`SAM_SLOPE_BITS(SUBPIXEL_BITS)-1:0] edges_a1_i,
    input  wire [`SAM_SLOPE_BITS(SUBPIXEL_BITS)-1:0] edges_b1_i,
    input  wire [`SAM_LOW_BITS-1:0]                  edges_low1_i,
    input  wire [`SAM_EDGE_BITS(SUBPIXEL_BITS)-1:0]  edges_value2_i,
    input  wire [`SAM_SLOPE_BITS(SUBPIXEL_BITS)-1:0] edges_a2_i,
    input  wire [`SAM_SLOPE_BITS(SUBPIXEL_BITS)-1:0] edges_b2_i,
    input  wire [`SAM_LOW_BITS-1:0]                  edges_low2_i,

    output wire                                      coverage_valid_o,
    input  wire                                      coverage_ready_i,
    output wire [`SAM_MASK_BITS(ANTIALIAS)-1:0]      coverage_mask_o,
    output wire [`SAM_AREA_BITS(ANTIALIAS)-1:0]      coverage_area_o,
    output wire                                      coverage_centre_o
);
    localparam E = `SAM_EDGE_BITS(SUBPIXEL_BITS);

    generate
        if (SUBPIXEL_BITS != 4 && SUBPIXEL_BITS != 8) begin : g_illegal_subpixel_bits
            sam_coverage_SUBPIXEL_BITS_must_be_4_or_8 u_error ();
        end
        if (ANTIALIAS != 0 && ANTIALIAS != 1) begin : g_illegal_antialias
            sam_coverage_ANTIALIAS_must_be_0_or_1 u_error ();
        end
    endgenerate

    wire centre = ~(edges_value0_i[E-1] | edges_value1_i[E-1] | edges_value2_i[E-1]);

    generate
        if (ANTIALIAS == 0) begin : g_whole
            assign coverage_mask_o = centre;
            wire unused = &{
                1'b0, edges_value0_i[E-2:0], edges_value1_i[E-2:0], edges_value2_i[E-2:0],
                edges_a0_i, edges_a1_i, edges_a2_i, edges_b0_i, edges_b1_i, edges_b2_i,
                edges_low0_i, edges_low1_i, edges_low2_i
            };
        end else begin : g_samples
            wire [15:0] mask0, mask1, mask2;

            sam_coverage_edge #(.SUBPIXEL_BITS(SUBPIXEL_BITS)) u_edge0 (
                .value_i(edges_value0_i),
                .a_i    (edges_a0_i),
                .b_i    (edges_b0_i),
                .low_i  (edges_low0_i),
                .mask_o (mask0)
            );
            sam_coverage_edge #(.SUBPIXEL_BITS(SUBPIXEL_BITS)) u_edge1 (
                .value_i(edges_value1_i),
                .a_i    (edges_a1_i),
                .b_i    (edges_b1_i),
                .low_i  (edges_low1_i),
                .mask_o (mask1)
            );
            sam_coverage_edge #(.SUBPIXEL_BITS(SUBPIXEL_BITS)) u_edge2 (
                .value_i(edges_value2_i),
                .a_i    (edges_a2_i),
                .b_i    (edges_b2_i),
                .low_i  (edges_low2_i),
                .mask_o (mask2)
            );
            assign coverage_mask_o = mask0 & mask1 & mask2;
        end
    endgenerate

    sam_popcount #(.ANTIALIAS(ANTIALIAS)) u_area (
        .mask_i(coverage_mask_o),
        .area_o(coverage_area_o)
    );

    assign edges_ready_o     = coverage_ready_i;
    assign coverage_valid_o  = edges_valid_i;
    assign coverage_centre_o = centre;

    wire unused_clock = &{1'b0, clk_i, rst_i};

`ifdef FORMAL
    wire [15:0] f_mask [0:2];
    sam_coverage_edge #(.SUBPIXEL_BITS(SUBPIXEL_BITS)) f_edge0 (.value_i(edges_value0_i),
        .a_i(edges_a0_i), .b_i(edges_b0_i), .low_i(edges_low0_i), .mask_o(f_mask[0]));
    sam_coverage_edge #(.SUBPIXEL_BITS(SUBPIXEL_BITS)) f_edge1 (.value_i(edges_value1_i),
        .a_i(edges_a1_i), .b_i(edges_b1_i), .low_i(edges_low1_i), .mask_o(f_mask[1]));
    sam_coverage_edge #(.SUBPIXEL_BITS(SUBPIXEL_BITS)) f_edge2 (.value_i(edges_value2_i),
        .a_i(edges_a2_i), .b_i(edges_b2_i), .low_i(edges_low2_i), .mask_o(f_mask[2]));
    wire f_centre = $signed(edges_value0_i) >= 0 & $signed(edges_value1_i) >= 0 & $signed(edges_value2_i) >= 0;
    always @* begin
        // The centre is covered where no edge function is negative.
        p_centre: assert (coverage_centre_o == f_centre);
        // A sample is covered where it is on the inner side of all three edges; the only one is the centre.
        p_mask: assert (coverage_mask_o == (ANTIALIAS == 0 ? f_centre : f_mask[0] & f_mask[1] & f_mask[2]));
        // The area is 0 where no sample is covered, full where all are.
        p_area: assert ((coverage_area_o == 0) == (coverage_mask_o == 0)
                      & (coverage_area_o == `SAM_FULL_AREA(ANTIALIAS)) == &coverage_mask_o);
    end
`endif
endmodule

`default_nettype wire
