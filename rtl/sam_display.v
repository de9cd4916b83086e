// Place of a secondary pixel on the display: mirrored and turned displays such as the Cyberscope.
//
// Latency: one clock.
// Reset: rst_i clears valid_q only.
// Paper: section 5.2.
`include "sam_formats.vh"
`default_nettype none

module sam_display #(
    // Fraction bits of a snapped vertex, sets the width of a coordinate: 4 or 8.
    parameter SUBPIXEL_BITS = 8
) (
    input  wire                                           clk_i,
    input  wire                                           rst_i,
    input  wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] width_i,

    input  wire                                           point_valid_i,
    output wire                                           point_ready_o,
    input  wire [`SAM_PIXEL_X_BITS(SUBPIXEL_BITS)-1:0]    point_x_i,
    input  wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] point_y_i,
    input  wire                                           point_swap_i,
    input  wire                                           point_mirror_i,

    output wire                                           pixel_valid_o,
    input  wire                                           pixel_ready_i,
    output wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] pixel_x_o,
    output wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] pixel_y_o
);
    localparam C = `SAM_COORDINATE_BITS(SUBPIXEL_BITS);
    localparam P = `SAM_PIXEL_X_BITS(SUBPIXEL_BITS);

    generate
        if (SUBPIXEL_BITS != 4 && SUBPIXEL_BITS != 8) begin : g_illegal
            sam_display_SUBPIXEL_BITS_must_be_4_or_8 u_error ();
        end
    endgenerate

    reg         valid_q;
    reg [C-1:0] x_q;
    reg [C-1:0] y_q;

    // width - 1 - x is width + ~x. The sign of x is dropped: a negative x is outside and is
    // never drawn.
    wire [C-1:0] from_right = width_i + ~point_x_i[C-1:0];
    wire [C-1:0] column     = point_mirror_i ? from_right : point_x_i[C-1:0];

    generate
        if (P > C) begin : g_sign
            wire unused = &{1'b0, point_x_i[P-1:C]};
        end
    endgenerate

    assign point_ready_o = ~valid_q | pixel_ready_i;

    always @(posedge clk_i) begin
        if (rst_i)              valid_q <= 1'b0;
        else if (point_ready_o) valid_q <= point_valid_i;

        if (point_valid_i & point_ready_o) begin
            x_q <= point_swap_i ? point_y_i : column;
            y_q <= point_swap_i ? column : point_y_i;
        end
    end

    assign pixel_valid_o = valid_q;
    assign pixel_x_o     = x_q;
    assign pixel_y_o     = y_q;
endmodule

`default_nettype wire
