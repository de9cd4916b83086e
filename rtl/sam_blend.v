// Blending of a secondary pixel with its background: C = S t + (1 - t) B, with t from alpha and
// from the covered area.
//
// Latency: two clocks: the difference S - B and t, then their product. The sum with B follows.
// Reset: rst_i clears the valids of the two stages only.
// Paper: section 5.7, equation 2.
`include "sam_formats.vh"
`default_nettype none

module sam_blend #(
    // 16 coverage samples a pixel: 0 or 1.
    parameter ANTIALIAS = 0,
    // Bits that accompany a pixel unchanged: 1 or more.
    parameter TAG_BITS = 1
) (
    input  wire                                 clk_i,
    input  wire                                 rst_i,

    input  wire                                 pixel_valid_i,
    output wire                                 pixel_ready_o,
    input  wire [`SAM_RGB_BITS-1:0]             pixel_rgb_i,
    input  wire [`SAM_CHANNEL_BITS-1:0]         pixel_alpha_i,
    input  wire [`SAM_AREA_BITS(ANTIALIAS)-1:0] pixel_area_i,
    input  wire [`SAM_RGB_BITS-1:0]             pixel_background_i,
    input  wire [TAG_BITS-1:0]                  pixel_tag_i,

    output wire                                 colour_valid_o,
    input  wire                                 colour_ready_i,
    output wire [`SAM_RGB_BITS-1:0]             colour_rgb_o,
    output wire [TAG_BITS-1:0]                  colour_tag_o
);
    localparam CHANNELS = `SAM_RGB_BITS / `SAM_CHANNEL_BITS;

    generate
        if (ANTIALIAS != 0 && ANTIALIAS != 1) begin : g_illegal_antialias
            sam_blend_ANTIALIAS_must_be_0_or_1 u_error ();
        end
        if (TAG_BITS < 1) begin : g_illegal_tag_bits
            sam_blend_TAG_BITS_must_be_1_or_more u_error ();
        end
    endgenerate

    reg                     factor_valid_q;
    reg [8:0]               factor_q;
    reg [`SAM_RGB_BITS-1:0] factor_background_q;
    reg [TAG_BITS-1:0]      factor_tag_q;
    reg                     colour_valid_q;
    reg [`SAM_RGB_BITS-1:0] colour_background_q;
    reg [TAG_BITS-1:0]      colour_tag_q;

    // 255 must become 256, so that an opaque pixel replaces the background exactly.
    wire [8:0] alpha = {1'b0, pixel_alpha_i} + {8'd0, pixel_alpha_i[7]};
    wire [8:0] factor;

    generate
        if (ANTIALIAS == 0) begin : g_whole
            assign factor = pixel_area_i[0] ? alpha : 9'd0;
        end else begin : g_samples
            wire [13:0] product = {5'd0, alpha} * {9'd0, pixel_area_i} + 14'd8;
            assign factor = product[12:4];
            wire unused = &{1'b0, product[13], product[3:0]};
        end
    endgenerate

    wire colour_free = ~colour_valid_q | colour_ready_i;

    assign pixel_ready_o = ~factor_valid_q | colour_free;

    always @(posedge clk_i) begin
        if (rst_i) begin
            factor_valid_q <= 1'b0;
            colour_valid_q <= 1'b0;
        end else begin
            if (pixel_ready_o) factor_valid_q <= pixel_valid_i;
            if (colour_free)   colour_valid_q <= factor_valid_q;
        end

        if (pixel_valid_i & pixel_ready_o) begin
            factor_q            <= factor;
            factor_background_q <= pixel_background_i;
            factor_tag_q        <= pixel_tag_i;
        end
        if (factor_valid_q & colour_free) begin
            colour_background_q <= factor_background_q;
            colour_tag_q        <= factor_tag_q;
        end
    end

    genvar i;
    generate
        for (i = 0; i < CHANNELS; i = i + 1) begin : g_channel
            // S - B, nine bits signed.
            reg  signed [8:0]  difference_q;
            wire signed [9:0]  weight  = {1'b0, factor_q};
            wire signed [18:0] product = difference_q * weight;
            // The product in whole steps, and one bit for the rounding: it is the carry into the
            // sum, which fits a channel, so that higher bits do not matter.
            reg  [8:0] change_q;
            wire [8:0] sum = {colour_background_q[8*i +: 8], 1'b1} + change_q;

            always @(posedge clk_i) begin
                if (pixel_valid_i & pixel_ready_o) begin
                    difference_q <= {1'b0, pixel_rgb_i[8*i +: 8]} - {1'b0, pixel_background_i[8*i +: 8]};
                end
                if (factor_valid_q & colour_free) change_q <= product[15:7];
            end

            assign colour_rgb_o[8*i +: 8] = sum[8:1];

            wire unused = &{1'b0, product[18:16], product[6:0], sum[0]};
        end
    endgenerate

    assign colour_valid_o = colour_valid_q;
    assign colour_tag_o   = colour_tag_q;
endmodule

`default_nettype wire
