// Queue between the background read of a secondary pixel and the pixel's output: holds slots of a
// primary and a secondary pixel in order while reads and blending are under way.
//
//   slot -> memory, request     response -> depth test, pixel -> (blend) -> colour, out
//
// A read waits while a slot in the queue holds a pixel of the same eye at the same place, so that
// memory which reads in order never answers with what has since been overwritten.
//
// Latency: one clock from slot to request; none from response to pixel and from colour to out.
// Reset: rst_i empties the queue; what the memory holds stays.
// Paper: section 5.7 (background), 6 (synchronisation of the pipelines).
`include "sam_formats.vh"
`default_nettype none

module sam_slot_queue #(
    // Fraction bits of a snapped vertex, sets the width of a coordinate: 4 or 8.
    parameter SUBPIXEL_BITS = 8,
    // 16 coverage samples a pixel, sets the width of an area: 0 or 1.
    parameter ANTIALIAS = 0,
    // Depth tested by the memory instead of here: 0 or 1.
    parameter DEPTH_EXTERNAL = 0,
    // Slots in flight: 2, 4, 8, 16 or 32.
    parameter SLOTS = 16
) (
    input  wire                                           clk_i,
    input  wire                                           rst_i,

    input  wire                                           slot_valid_i,
    output wire                                           slot_ready_o,
    input  wire                                           slot_primary_i,
    input  wire                                           slot_secondary_i,
    input  wire                                           slot_eye_i,
    input  wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] slot_primary_x_i,
    input  wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] slot_primary_y_i,
    input  wire [`SAM_RGBA_BITS-1:0]                      slot_primary_rgba_i,
    input  wire [`SAM_AREA_BITS(ANTIALIAS)-1:0]           slot_primary_area_i,
    input  wire [`SAM_DEPTH_BITS-1:0]                     slot_primary_depth_i,
    input  wire                                           slot_primary_write_i,
    input  wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] slot_secondary_x_i,
    input  wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] slot_secondary_y_i,
    input  wire [`SAM_RGBA_BITS-1:0]                      slot_secondary_rgba_i,
    input  wire [`SAM_AREA_BITS(ANTIALIAS)-1:0]           slot_secondary_area_i,
    input  wire [`SAM_DEPTH_BITS-1:0]                     slot_secondary_depth_i,
    input  wire                                           slot_secondary_write_i,

    output wire                                           request_valid_o,
    input  wire                                           request_ready_i,
    output wire                                           request_eye_o,
    output wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] request_x_o,
    output wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] request_y_o,

    input  wire                                           response_valid_i,
    output wire                                           response_ready_o,
    input  wire [`SAM_DEPTH_BITS-1:0]                     response_depth_i,

    // To blend, whose background is the response's colour; `visible` comes back with the colour.
    output wire                                           pixel_valid_o,
    input  wire                                           pixel_ready_i,
    output wire [`SAM_RGBA_BITS-1:0]                      pixel_rgba_o,
    output wire [`SAM_AREA_BITS(ANTIALIAS)-1:0]           pixel_area_o,
    output wire                                           pixel_visible_o,
    input  wire                                           colour_valid_i,
    output wire                                           colour_ready_o,
    input  wire [`SAM_RGB_BITS-1:0]                       colour_rgb_i,
    input  wire                                           colour_visible_i,

    output wire                                           out_valid_o,
    input  wire                                           out_ready_i,
    output wire                                           out_primary_o,
    output wire                                           out_secondary_o,
    output wire                                           out_eye_o,
    output wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] out_primary_x_o,
    output wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] out_primary_y_o,
    output wire [`SAM_RGBA_BITS-1:0]                      out_primary_rgba_o,
    output wire [`SAM_AREA_BITS(ANTIALIAS)-1:0]           out_primary_area_o,
    output wire [`SAM_DEPTH_BITS-1:0]                     out_primary_depth_o,
    output wire                                           out_primary_write_o,
    output wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] out_secondary_x_o,
    output wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] out_secondary_y_o,
    output wire [`SAM_RGBA_BITS-1:0]                      out_secondary_rgba_o,
    output wire [`SAM_AREA_BITS(ANTIALIAS)-1:0]           out_secondary_area_o,
    output wire [`SAM_DEPTH_BITS-1:0]                     out_secondary_depth_o,
    output wire                                           out_secondary_write_o
);
    localparam C = `SAM_COORDINATE_BITS(SUBPIXEL_BITS);
    localparam A = `SAM_AREA_BITS(ANTIALIAS);
    localparam D = `SAM_DEPTH_BITS;
    localparam N = SLOTS == 2 ? 1 : SLOTS == 4 ? 2 : SLOTS == 8 ? 3 : SLOTS == 16 ? 4 : 5;

    generate
        if (SUBPIXEL_BITS != 4 && SUBPIXEL_BITS != 8) begin : g_illegal_subpixel_bits
            sam_slot_queue_SUBPIXEL_BITS_must_be_4_or_8 u_error ();
        end
        if (ANTIALIAS != 0 && ANTIALIAS != 1) begin : g_illegal_antialias
            sam_slot_queue_ANTIALIAS_must_be_0_or_1 u_error ();
        end
        if (DEPTH_EXTERNAL != 0 && DEPTH_EXTERNAL != 1) begin : g_illegal_depth_external
            sam_slot_queue_DEPTH_EXTERNAL_must_be_0_or_1 u_error ();
        end
        if (SLOTS != 2 && SLOTS != 4 && SLOTS != 8 && SLOTS != 16 && SLOTS != 32) begin : g_illegal_slots
            sam_slot_queue_SLOTS_must_be_2_or_4_or_8_or_16_or_32 u_error ();
        end
    endgenerate

    // Where slots enter, where a response is due, where slots leave. One bit more than an index
    // has, to tell a full queue from an empty one.
    reg [N:0] enter_q;
    reg [N:0] answer_q;
    reg [N:0] leave_q;

    wire [N-1:0] enter_index  = enter_q[N-1:0];
    wire [N-1:0] answer_index = answer_q[N-1:0];
    wire [N-1:0] leave_index  = leave_q[N-1:0];

    wire empty   = enter_q == leave_q;
    wire settled = enter_q == answer_q;

    wire push, pop;

    // A slot enters while there is a place for it and for the read of a secondary. Kept in a register
    // of its own, as all stages before wait for it.
    reg        room_q;
    reg        full_q;
    wire [N:0] enter_next = enter_q + {{N{1'b0}}, 1'b1};
    wire       last_place = enter_next == {~leave_q[N], leave_index};
    wire       full_d     = (full_q | (push & last_place)) & ~pop;
    wire       next_d;

    // Memories by who reads: blend, both, the output. The free place is written whether a
    // slot enters or not, which keeps the path to the write enables short.
    reg [`SAM_RGB_BITS-1:0]              source_q [0:SLOTS-1];
    reg [A+D+7:0]                        tested_q [0:SLOTS-1];
    reg [4*C+`SAM_RGBA_BITS+A+D+1:0]     placed_q [0:SLOTS-1];
    reg [2:0]                            flags_q [0:SLOTS-1];

    always @(posedge clk_i) begin
        if (room_q) begin
            source_q[enter_index] <= slot_secondary_rgba_i[`SAM_RGB_BITS-1:0];
            tested_q[enter_index] <= {
                slot_secondary_rgba_i[`SAM_RGBA_BITS-1:`SAM_RGB_BITS],
                slot_secondary_area_i, slot_secondary_depth_i
            };
            placed_q[enter_index] <= {
                slot_primary_write_i, slot_secondary_write_i,
                slot_primary_x_i, slot_primary_y_i, slot_primary_rgba_i, slot_primary_area_i,
                slot_primary_depth_i, slot_secondary_x_i, slot_secondary_y_i
            };
            flags_q[enter_index] <= {slot_primary_i, slot_secondary_i, slot_eye_i};
        end
    end

    // Response: passes over slots without a secondary, one a clock.
    wire         answer_secondary = flags_q[answer_index][1];
    wire [7:0]   answer_alpha;
    wire [D-1:0] answer_depth;

    assign {answer_alpha, pixel_area_o, answer_depth} = tested_q[answer_index];

    wire answered = response_valid_i & pixel_ready_i;

    assign pixel_valid_o    = response_valid_i & ~settled & answer_secondary;
    assign response_ready_o = pixel_ready_i & ~settled & answer_secondary;
    assign pixel_rgba_o     = {answer_alpha, source_q[answer_index]};
    assign pixel_visible_o  = (DEPTH_EXTERNAL != 0) | (answer_depth < response_depth_i);

    // Output: a slot with a secondary waits for its colour. What decides whether it leaves is read a
    // clock before it is first in the queue, or taken from a slot that enters just then.
    reg  [2:0]   head_q;
    wire [2:0]   enter_flags = {slot_primary_i, slot_secondary_i, slot_eye_i};
    wire [N:0]   leave_next  = leave_q + {{N{1'b0}}, 1'b1};
    wire [2:0]   head        = empty ? enter_flags : flags_q[leave_index];
    wire [2:0]   second      = enter_q == leave_next ? enter_flags : flags_q[leave_next[N-1:0]];
    wire         leave_secondary;
    wire [7:0]   leave_alpha;

    always @(posedge clk_i) head_q <= pop ? second : head;

    assign {out_primary_o, leave_secondary, out_eye_o} = head_q;
    assign {leave_alpha, out_secondary_area_o, out_secondary_depth_o} = tested_q[leave_index];
    assign {
        out_primary_write_o, out_secondary_write_o,
        out_primary_x_o, out_primary_y_o, out_primary_rgba_o, out_primary_area_o,
        out_primary_depth_o, out_secondary_x_o, out_secondary_y_o
    } = placed_q[leave_index];
    assign out_valid_o          = ~empty & (~leave_secondary | colour_valid_i);
    assign out_secondary_o      = leave_secondary & colour_visible_i;
    assign out_secondary_rgba_o = {leave_alpha, colour_rgb_i};
    assign colour_ready_o       = ~empty & leave_secondary & out_ready_i;
    assign pop                  = out_valid_o & out_ready_i;

    // Read: which slots hold its place is found when it enters; it then waits for them to leave. A
    // second read waits behind the first, so that slots enter without waiting for request_ready_i.
    reg              read_q;
    reg [2*C:0]      read_place_q;
    reg [SLOTS-1:0]  blocked_q;
    reg              next_q;
    reg [2*C:0]      next_place_q;
    reg [SLOTS-1:0]  next_blocked_q;
    wire [SLOTS-1:0] same_place;
    wire [SLOTS-1:0] left;
    reg              pop_q;
    reg [N-1:0]      left_index_q;

    wire             enter_read    = push & slot_secondary_i;
    wire [2*C:0]     enter_place   = {~slot_eye_i, slot_secondary_x_i, slot_secondary_y_i};
    wire             keep          = read_q & ~(request_valid_o & request_ready_i);

    assign push            = slot_valid_i & slot_ready_o;
    assign slot_ready_o    = room_q;
    assign next_d          = keep & (next_q | enter_read);
    assign request_valid_o = read_q & (blocked_q == {SLOTS{1'b0}});
    assign {request_eye_o, request_x_o, request_y_o} = read_place_q;

    always @(posedge clk_i) begin
        if (rst_i) begin
            enter_q  <= {(N + 1){1'b0}};
            answer_q <= {(N + 1){1'b0}};
            leave_q  <= {(N + 1){1'b0}};
            room_q   <= 1'b1;
            full_q   <= 1'b0;
            read_q   <= 1'b0;
            next_q   <= 1'b0;
            pop_q    <= 1'b0;
        end else begin
            room_q <= ~full_d & ~next_d;
            full_q <= full_d;
            if (push) enter_q <= enter_next;
            if (~settled & (~answer_secondary | answered)) answer_q <= answer_q + {{N{1'b0}}, 1'b1};
            pop_q  <= pop;
            if (pop) leave_q <= leave_next;
            read_q <= keep | next_q | enter_read;
            next_q <= next_d;
        end

        left_index_q <= leave_index;
        if (~keep) begin
            read_place_q <= next_q ? next_place_q : enter_place;
            blocked_q    <= next_q ? next_blocked_q & ~left : same_place & ~left;
        end else begin
            blocked_q    <= blocked_q & ~left;
        end
        if (~next_q) begin
            next_place_q   <= enter_place;
            next_blocked_q <= same_place & ~left;
        end else begin
            next_blocked_q <= next_blocked_q & ~left;
        end
    end

    // The places are kept a second time in registers, as all are compared at once.
    genvar i;
    generate
        for (i = 0; i < SLOTS; i = i + 1) begin : g_place
            reg           occupied_q;
            reg           primary_q;
            reg           secondary_q;
            reg           eye_q;
            reg [2*C-1:0] primary_place_q;
            reg [2*C-1:0] secondary_place_q;

            // The secondary that enters is of the eye that is not `slot_eye_i`.
            wire           other = eye_q != slot_eye_i;
            wire           held  = other ? primary_q : secondary_q;
            wire [2*C-1:0] place = other ? primary_place_q : secondary_place_q;

            // That a slot left is noted a clock late, which keeps the path from the output short.
            assign left[i]       = pop_q & (left_index_q == i);
            assign same_place[i] = occupied_q & held & (place == {slot_secondary_x_i, slot_secondary_y_i});

            always @(posedge clk_i) begin
                if (rst_i) occupied_q <= 1'b0;
                else       occupied_q <= (push & (enter_index == i)) | (occupied_q & ~left[i]);

                if (room_q & (enter_index == i)) begin
                    primary_q         <= slot_primary_i;
                    secondary_q       <= slot_secondary_i;
                    eye_q             <= slot_eye_i;
                    primary_place_q   <= {slot_primary_x_i, slot_primary_y_i};
                    secondary_place_q <= {slot_secondary_x_i, slot_secondary_y_i};
                end
            end
        end
    endgenerate
endmodule

`default_nettype wire
