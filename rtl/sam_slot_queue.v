// Queue between the background read of a secondary pixel and the pixel's output.
//
//   slot, secondary -> request, queue     response -> depth test -> (blend) -> out
//   slot, primary ---> out, or into the queue where a pixel of its eye is before it
//
// A primary pixel passes the queue, unless that would change the order of its eye's pixels. The
// payload that blend does not need goes along with the pixel in stages of its own.
//
// A secondary that falls where a pixel under way does, of the same eye, waits until none is under
// way: so memory which reads in order never answers with what has since been overwritten.
//
// Latency: one clock from slot to request, none from response to pixel, one from colour to out; a
// response is taken two clocks after its request at the earliest. With fewer than 8 slots none, none,
// none and one.
// Reset: rst_i empties the queue; no data is reset.
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
    input  wire                                           single_i,

    // Where the secondary of the next slot is and whose it is: compared a clock ahead.
    input  wire                                           next_eye_i,
    input  wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] next_x_i,
    input  wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] next_y_i,

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
    input  wire [`SAM_RGB_BITS-1:0]                       response_rgb_i,
    input  wire [`SAM_DEPTH_BITS-1:0]                     response_depth_i,

    // To blend; `visible` comes back with the colour.
    output wire                                           pixel_valid_o,
    input  wire                                           pixel_ready_i,
    output wire [`SAM_RGBA_BITS-1:0]                      pixel_rgba_o,
    output wire [`SAM_AREA_BITS(ANTIALIAS)-1:0]           pixel_area_o,
    output wire [`SAM_RGB_BITS-1:0]                       pixel_background_o,
    output wire                                           pixel_visible_o,
    input  wire                                           colour_valid_i,
    output wire                                           colour_ready_o,
    input  wire [`SAM_RGB_BITS-1:0]                       colour_rgb_i,
    input  wire                                           colour_visible_i,

    output wire                                           out_valid_o,
    input  wire                                           out_ready_i,
    output wire                                           out_primary_o,
    output wire                                           out_secondary_o,
    output wire                                           out_blended_o,
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

    // A pixel {x, y, rgba, kept}, a slot {primary, secondary, eye, primary pixel, secondary pixel},
    // a place with its eye, and a pixel in the queue.
    localparam K = A + D + 1;
    localparam X = 2 * C + `SAM_RGBA_BITS + K;
    localparam S = 3 + 2 * X;
    localparam P = 1 + 2 * C;
    localparam E = 1 + `SAM_RGBA_BITS + K;
    // A short queue is the one of fewest gates. A long one is for a fast clock: slots come and leave
    // through buffers, a register is behind the queue's memory, and what a slot waits for is found a
    // clock ahead, so that it may wait a clock longer.
    localparam SHORT = SLOTS < 8;
    localparam WORDS = SHORT ? 1 : 5;

    // The slot at work, and whether its secondary may have to wait for its place.
    wire         front_valid, front_ready, front_primary, front_secondary, front_eye, waits;
    wire [X-1:0] front_primary_pixel, front_secondary_pixel;
    wire [S-1:0] front;

    assign {front_primary, front_secondary, front_eye, front_primary_pixel, front_secondary_pixel}
        = front;

    wire [P-1:0] primary_place   = {front_eye, front_primary_pixel[X-1 -: 2*C]};
    wire [P-1:0] secondary_place = {~front_eye, front_secondary_pixel[X-1 -: 2*C]};

    // In the queue, in a stage before blend and in two beside it.
    reg  [N:0]       enter_q;
    reg  [N:0]       leave_q;
    reg  [SLOTS-1:0] occupied_q;
    wire [2:0]       stage_valid;
    wire [P-1:0]     stage_place [0:2];

    wire [N-1:0] enter_index = enter_q[N-1:0];
    wire [N-1:0] leave_index = leave_q[N-1:0];
    wire         empty       = enter_q == leave_q;
    wire         full;
    wire         push, pop, out_busy;
    wire         idle        = empty & (stage_valid == 3'd0) & ~out_busy;

    wire         room        = ~full | (SHORT & pop);

    // What of the slot is gone already, and what goes now. A primary that goes through the queue is
    // there before its secondary. Unless both go to one display, one with a secondary waits instead
    // until it can pass: those after it would never pass again.
    reg          primary_gone_q;
    reg          secondary_gone_q;
    wire         held;
    wire         out_taken;
    wire primary_here   = front_valid & front_primary & ~primary_gone_q;
    wire secondary_here = front_valid & front_secondary & ~secondary_gone_q;
    wire passes         = primary_here & ~held;
    wire queued         = primary_here & held & (single_i | ~front_secondary);
    wire primary_done   = ~primary_here | (held ? queued & room : out_taken);
    wire secondary_done = ~secondary_here | (request_valid_o & request_ready_i);

    assign request_valid_o = secondary_here & ~(primary_here & single_i) & room & ~waits;
    assign {request_eye_o, request_x_o, request_y_o} = secondary_place;
    assign push            = (queued & room) | (request_valid_o & request_ready_i);
    assign front_ready     = primary_done & secondary_done;

    always @(posedge clk_i) begin
        if (rst_i) begin
            enter_q          <= {(N + 1){1'b0}};
            leave_q          <= {(N + 1){1'b0}};
            primary_gone_q   <= 1'b0;
            secondary_gone_q <= 1'b0;
        end else begin
            if (push) enter_q <= enter_q + {{N{1'b0}}, 1'b1};
            if (pop)  leave_q <= leave_q + {{N{1'b0}}, 1'b1};
            primary_gone_q   <= ~front_ready & front_primary & primary_done;
            secondary_gone_q <= ~front_ready & front_secondary & secondary_done;
        end
    end

    // The queue: what all are compared by in registers, the rest in a memory. The free place is written
    // whether a pixel enters or not: that is known late, and all the places are far.
    reg  [E-1:0] rest_q [0:SLOTS-1];
    wire [P-1:0] place [0:SLOTS-1];
    wire [P-1:0] enter_place = queued ? primary_place : secondary_place;

    always @(posedge clk_i) begin
        if (room) begin
            rest_q[enter_index] <= queued ? {1'b0, front_primary_pixel[X-2*C-1:0]}
                                          : {1'b1, front_secondary_pixel[X-2*C-1:0]};
        end
    end

    genvar i;
    generate
        for (i = 0; i < SLOTS; i = i + 1) begin : g_place
            reg [P-1:0] place_q;

            assign place[i] = place_q;

            always @(posedge clk_i) begin
                if (room & (enter_index == i)) place_q <= enter_place;

                if (rst_i) occupied_q[i] <= 1'b0;
                else       occupied_q[i] <= (push & (enter_index == i))
                                          | (occupied_q[i] & ~(pop & (leave_index == i)));
            end
        end
    endgenerate

    // All that is under way: in the queue and its stages, and in slots before and after them. Places
    // are compared by their low bits, which differ where pixels are near each other: others wait in
    // vain once in a thousand times.
    localparam M = 11;
    localparam I = SLOTS + 3;
    localparam U = I + 2 * WORDS;

    wire [WORDS-1:0]   word_valid;
    wire [WORDS*S-1:0] word;
    wire [U-1:0]       way_valid, way_eye, alike;
    wire [M-1:0]       next_mark = {next_eye_i, next_x_i[5:0], next_y_i[3:0]};

    generate
        for (i = 0; i < U; i = i + 1) begin : g_way
            wire [P-1:0] at;

            if (i < SLOTS) begin : g_queue
                assign way_valid[i] = occupied_q[i];
                assign at           = place[i];
            end else if (i < I) begin : g_stage
                assign way_valid[i] = stage_valid[i-SLOTS];
                assign at           = stage_place[i-SLOTS];
            end else begin : g_slot
                localparam W = (i - I) / 2;
                localparam T = (i - I) % 2;
                wire [S-1:0] slot = word[W*S +: S];

                // The secondary is the lower pixel, of the other eye.
                assign way_valid[i] = word_valid[W] & slot[S-2+T];
                assign at           = {slot[S-3] ^ (T == 0), slot[T*X+X-1 -: 2*C]};
                wire unused = &{1'b0, slot};
            end
            assign way_eye[i] = at[P-1];
            assign alike[i]   = way_valid[i] & ({at[P-1], at[C +: 6], at[3:0]} == next_mark);
            wire unused = &{1'b0, at};
        end
    endgenerate

    // A primary is held where a pixel of its eye is in the queue or its stages, or all go to one
    // display.
    wire [S-1:0] slot = {
        slot_primary_i, slot_secondary_i, slot_eye_i,
        slot_primary_x_i, slot_primary_y_i, slot_primary_rgba_i,
        slot_primary_area_i, slot_primary_depth_i, slot_primary_write_i,
        slot_secondary_x_i, slot_secondary_y_i, slot_secondary_rgba_i,
        slot_secondary_area_i, slot_secondary_depth_i, slot_secondary_write_i
    };
    wire [S:0] out, leaving;
    wire       out_valid;

    // The next slot is compared with all that is under way. As that takes a clock, what it finds may
    // have left since.
    generate
        if (SHORT) begin : g_short
            reg waits_q;

            always @(posedge clk_i) begin
                if (slot_ready_o) waits_q <= alike != {U{1'b0}};
                else if (idle)    waits_q <= 1'b0;
            end

            assign waits        = waits_q;
            assign held         = single_i | ((way_valid[I-1:0] & (way_eye[I-1:0] ~^ {I{front_eye}})) != {I{1'b0}});
            assign full         = enter_q == {~leave_q[N], leave_index};
            assign front_valid  = slot_valid_i;
            assign front        = slot;
            assign slot_ready_o = front_ready;
            assign word         = slot;
            assign word_valid   = slot_valid_i;
            assign out_valid_o  = out_valid;
            assign out_taken    = out_ready_i;
            assign leaving      = out;
            assign out_busy     = 1'b0;
        end else begin : g_long
            reg  [U-1:0] alike_q;
            reg  [1:0]   eyes_q;
            reg          idle_q, full_q, drained_q, epoch_q, slot_epoch_q;
            wire         back_valid, out_back_valid, front_near, front_far, front_epoch;
            wire [2:0]   back_meets;
            wire [S-1:0] back;
            wire [S:0]   out_back;
            wire [N:0]   used = enter_q - leave_q;

            // What a slot met: another slot, or what was on its way, which matters no longer when an
            // epoch has ended by all of that having left. Two ends are taken for none.
            localparam FAR = I + 4;
            wire near = alike_q[U-1:FAR] != {(U - FAR){1'b0}};
            wire far  = alike_q[FAR-1:0] != {FAR{1'b0}};

            sam_buffer #(.WIDTH(S + 3)) u_slots (
                .clk_i(clk_i), .rst_i(rst_i),
                .in_valid_i(slot_valid_i), .in_ready_o(slot_ready_o),
                .in_data_i({near, far, slot_epoch_q, slot}),
                .out_valid_o(front_valid), .out_ready_i(front_ready),
                .out_data_o({front_near, front_far, front_epoch, front}),
                .back_valid_o(back_valid), .back_data_o({back_meets, back})
            );
            sam_buffer #(.WIDTH(S + 1)) u_out (
                .clk_i(clk_i), .rst_i(rst_i),
                .in_valid_i(out_valid), .in_ready_o(out_taken), .in_data_i(out),
                .out_valid_o(out_valid_o), .out_ready_i(out_ready_i), .out_data_o(leaving),
                .back_valid_o(out_back_valid), .back_data_o(out_back)
            );

            always @(posedge clk_i) begin
                if (~slot_valid_i | slot_ready_o) {alike_q, slot_epoch_q} <= {alike, epoch_q};

                drained_q <= idle;
                epoch_q   <= ~rst_i & (epoch_q ^ (idle & ~drained_q));

                if (front_ready) idle_q <= 1'b0;
                else if (idle)   idle_q <= 1'b1;

                eyes_q[0] <= ((way_valid[I-1:0] & ~way_eye[I-1:0]) != {I{1'b0}}) | (push & ~enter_place[P-1]);
                eyes_q[1] <= ((way_valid[I-1:0] &  way_eye[I-1:0]) != {I{1'b0}}) | (push &  enter_place[P-1]);

                if (rst_i) full_q <= 1'b0;
                else       full_q <= ~pop & (full_q | (push & (used == SLOTS[N:0] - {{N{1'b0}}, 1'b1})));
            end

            assign waits      = (front_near | (front_far & (front_epoch == epoch_q))) & ~idle_q;
            assign held       = single_i | eyes_q[front_eye];
            assign full       = full_q;
            assign out_busy   = out_valid_o;
            // The slots come last.
            assign word       = {slot, back, front, out_back[S-1:0], leaving[S-1:0]};
            assign word_valid = {slot_valid_i, back_valid, front_valid, out_back_valid, out_valid_o};
            wire unused = &{1'b0, back_meets, out_back[S]};
        end
    endgenerate

    // First in the queue: a secondary waits for its response, a primary until nothing is before it.
    wire [P-1:0]              first_place;
    wire                      first_valid, first_taken, first_read;
    wire [`SAM_RGBA_BITS-1:0] first_rgba;
    wire [K-1:0]              first_kept;

    generate
        if (SHORT) begin : g_no_first
            assign first_valid = ~empty;
            assign {first_place, first_read, first_rgba, first_kept}
                = {place[leave_index], rest_q[leave_index]};
            assign pop            = first_taken;
            assign stage_valid[0] = 1'b0;
        end else begin : g_first
            wire first_ready;

            sam_stage #(.WIDTH(P + E)) u_first (
                .clk_i(clk_i), .rst_i(rst_i),
                .in_valid_i(~empty), .in_ready_o(first_ready),
                .in_data_i({place[leave_index], rest_q[leave_index]}),
                .out_valid_o(first_valid), .out_ready_i(first_taken),
                .out_data_o({first_place, first_read, first_rgba, first_kept})
            );
            assign pop            = ~empty & first_ready;
            assign stage_valid[0] = first_valid;
        end
    endgenerate
    assign stage_place[0] = first_place;

    wire primary_first = first_valid & ~first_read & (stage_valid[2:1] == 2'd0);

    assign pixel_valid_o      = response_valid_i & first_valid & first_read;
    assign response_ready_o   = pixel_ready_i & first_valid & first_read;
    assign pixel_rgba_o       = first_rgba;
    assign pixel_area_o       = first_kept[1 + D +: A];
    assign pixel_background_o = response_rgb_i;
    assign pixel_visible_o    = (DEPTH_EXTERNAL != 0) | (first_kept[1 +: D] < response_depth_i);
    assign first_taken        = (pixel_valid_o & pixel_ready_i) | (primary_first & out_taken);

    // In step with the two stages of blend.
    wire         step_ready, factor_ready, colour_valid;
    wire [7:0]   factor_alpha, colour_alpha;
    wire [K-1:0] factor_kept, colour_kept;
    wire [P-1:0] factor_place;

    sam_stage #(.WIDTH(8 + K + P)) u_factor (
        .clk_i(clk_i), .rst_i(rst_i), .in_valid_i(pixel_valid_o), .in_ready_o(step_ready),
        .in_data_i({first_rgba[`SAM_RGBA_BITS-1:`SAM_RGB_BITS], first_kept, first_place}),
        .out_valid_o(stage_valid[1]), .out_ready_i(factor_ready),
        .out_data_o({factor_alpha, factor_kept, factor_place})
    );
    assign stage_place[1] = factor_place;

    sam_stage #(.WIDTH(8 + K + P)) u_colour (
        .clk_i(clk_i), .rst_i(rst_i), .in_valid_i(stage_valid[1]), .in_ready_o(factor_ready),
        .in_data_i({factor_alpha, factor_kept, factor_place}),
        .out_valid_o(colour_valid), .out_ready_i(colour_ready_o),
        .out_data_o({colour_alpha, colour_kept, stage_place[2]})
    );
    assign stage_valid[2] = colour_valid;

    // Output: a primary that passes beside the pixel from the queue, which is of the other eye.
    wire         out_secondary = primary_first | (colour_valid_i & colour_visible_i);
    wire [P-1:0] out_place     = primary_first ? first_place : stage_place[2];

    assign out = {
        ~primary_first, passes, out_secondary, out_secondary ? ~out_place[P-1] : front_eye,
        front_primary_pixel, out_place[P-2:0],
        primary_first ? {first_rgba, first_kept} : {colour_alpha, colour_rgb_i, colour_kept}
    };
    assign out_valid      = passes | out_secondary;
    assign colour_ready_o = ~colour_visible_i | out_taken;
    assign {
        out_blended_o, out_primary_o, out_secondary_o, out_eye_o,
        out_primary_x_o, out_primary_y_o, out_primary_rgba_o,
        out_primary_area_o, out_primary_depth_o, out_primary_write_o,
        out_secondary_x_o, out_secondary_y_o, out_secondary_rgba_o,
        out_secondary_area_o, out_secondary_depth_o, out_secondary_write_o
    } = leaving;

    wire unused = &{1'b0, step_ready, next_x_i, next_y_i, way_eye};

`ifdef FORMAL
`include "sam_formal.vh"
    `SAM_BEGIN
    // Blend between pixel and colour.
    wire f_blend_ready, f_colour_valid, f_colour_visible;
    wire [`SAM_RGB_BITS-1:0] f_colour;
    sam_blend #(.ANTIALIAS(ANTIALIAS), .TAG_BITS(1)) f_blend (.clk_i(clk_i), .rst_i(rst_i),
        .pixel_valid_i(pixel_valid_o), .pixel_ready_o(f_blend_ready), .pixel_rgb_i(`SAM_RGB_BITS'd0),
        .pixel_alpha_i(8'd0), .pixel_area_i(pixel_area_o), .pixel_background_i(`SAM_RGB_BITS'd0),
        .pixel_tag_i(pixel_visible_o), .colour_valid_o(f_colour_valid), .colour_ready_i(colour_ready_o),
        .colour_rgb_o(f_colour), .colour_tag_o(f_colour_visible));
    always @* assume (pixel_ready_i == f_blend_ready & colour_valid_i == f_colour_valid
                      & colour_visible_i == f_colour_visible);

    // Memory that answers what was asked.
    reg [6:0] f_reads;
    always @(posedge clk_i) begin
        f_reads <= rst_i ? 0 : f_reads + (request_valid_o & request_ready_i) - (response_valid_i & response_ready_o);
        assume (~f_begun | ~response_valid_i | f_reads != 0);
        assume (`SAM_WAITS(response_valid_i, response_ready_o, {response_rgb_i, response_depth_i}));
    end

    // A slot is new when the one before it has been taken. It was announced in the clock before.
    localparam F = 2 * C + A + D + 2;
    wire f_taken = slot_valid_i & slot_ready_o;
    wire f_asked = request_valid_o & request_ready_i;
    wire f_out   = out_valid_o & out_ready_i;
    reg  f_old, f_dropped;
    wire f_new   = slot_valid_i & ~f_old & ~rst_i;
    wire [F-1:0] f_primary   = {slot_primary_x_i, slot_primary_y_i, slot_primary_area_i, slot_primary_depth_i,
                                slot_primary_write_i, 1'b0};
    wire [F-1:0] f_secondary = {slot_secondary_x_i, slot_secondary_y_i, slot_secondary_area_i,
                                slot_secondary_depth_i, slot_secondary_write_i, 1'b1};
    always @(posedge clk_i) begin
        f_old     <= ~rst_i & slot_valid_i & ~slot_ready_o;
        // What the depth test drops leaves unseen: the properties of order speak of all before.
        f_dropped <= ~rst_i & (f_dropped | (colour_valid_i & colour_ready_o & ~colour_visible_i));
        assume (`SAM_WAITS(slot_valid_i, slot_ready_o, {slot_primary_i, slot_secondary_i, slot_eye_i,
            f_primary, slot_primary_rgba_i, f_secondary, slot_secondary_rgba_i}));
        assume (~f_begun | $stable(single_i));
    end
    reg f_announced_eye;
    reg [2*C-1:0] f_announced;
    always @(posedge clk_i) {f_announced_eye, f_announced} <= {next_eye_i, next_x_i, next_y_i};
    always @* assume (~f_begun | ~f_new | {~slot_eye_i, slot_secondary_x_i, slot_secondary_y_i}
                                        == {f_announced_eye, f_announced});

    // The pixels of one eye, and of them the one of some number: as it came, and as it leaves.
    wire       f_eye    = $anyconst;
    wire [3:0] f_number = $anyconst;
    wire f_is_primary   = slot_primary_i & slot_eye_i == f_eye;
    wire f_is_secondary = slot_secondary_i & slot_eye_i != f_eye;
    wire f_comes        = f_new & (f_is_primary | f_is_secondary);
    wire f_leaves_first = f_out & out_primary_o & out_eye_o == f_eye;
    wire f_leaves_other = f_out & out_secondary_o & out_eye_o != f_eye;
    wire [F-1:0] f_left_first = {out_primary_x_o, out_primary_y_o, out_primary_area_o, out_primary_depth_o,
                                 out_primary_write_o, 1'b0};
    wire [F-1:0] f_left_other = {out_secondary_x_o, out_secondary_y_o, out_secondary_area_o,
                                 out_secondary_depth_o, out_secondary_write_o, out_blended_o};
    reg  [3:0]   f_came, f_left;
    reg  [F-1:0] f_kept;
    wire [F-1:0] f_pixel = f_comes & f_came == f_number ? (f_is_primary ? f_primary : f_secondary) : f_kept;
    wire [3:0]   f_all   = f_came + f_comes;
    always @(posedge clk_i) begin
        f_kept <= f_pixel;
        f_came <= rst_i ? 0 : f_all;
        f_left <= rst_i ? 0 : f_left + f_leaves_first + f_leaves_other;
    end

    // One place of that eye: the pixels that came to it, and that left.
    wire [2*C-1:0] f_place = $anyconst;
    wire f_comes_there = f_comes & (f_is_primary ? f_primary : f_secondary) >> (A + D + 2) == f_place;
    wire f_leaves_there = (f_leaves_first & f_left_first >> (A + D + 2) == f_place)
                        | (f_leaves_other & f_left_other >> (A + D + 2) == f_place);
    reg [3:0] f_came_there, f_left_there;
    always @(posedge clk_i) begin
        f_came_there <= rst_i ? 0 : f_came_there + f_comes_there;
        f_left_there <= rst_i ? 0 : f_left_there + f_leaves_there;
    end

    // The secondary of some number, with what had come to the place before; its read; and the answer.
    localparam R = 4 + P + `SAM_RGBA_BITS + A + D;
    reg  [3:0]   f_seconds, f_asks, f_answers, f_pixels;
    reg  [R-1:0] f_second_kept;
    wire         f_comes_second = f_new & slot_secondary_i;
    wire [R-1:0] f_second = f_comes_second & f_seconds == f_number
        ? {f_came_there, ~slot_eye_i, slot_secondary_x_i, slot_secondary_y_i,
           slot_secondary_rgba_i, slot_secondary_area_i, slot_secondary_depth_i}
        : f_second_kept;
    wire [3:0]                f_before;
    wire [P-1:0]              f_at;
    wire [`SAM_RGBA_BITS-1:0] f_rgba;
    wire [A-1:0]              f_area;
    wire [D-1:0]              f_depth;
    assign {f_before, f_at, f_rgba, f_area, f_depth} = f_second;
    // A short queue shows the answer before it is taken.
    wire f_answers_it = response_valid_i & f_answers == f_number;
    reg  [`SAM_RGB_BITS+D-1:0] f_answered;
    wire [`SAM_RGB_BITS+D-1:0] f_answer = f_answers_it ? {response_rgb_i, response_depth_i} : f_answered;
    always @(posedge clk_i) begin
        f_second_kept <= f_second;
        f_answered    <= f_answer;
        f_seconds     <= rst_i ? 0 : f_seconds + f_comes_second;
        f_asks        <= rst_i ? 0 : f_asks + f_asked;
        f_answers     <= rst_i ? 0 : f_answers + (response_valid_i & response_ready_o);
        f_pixels      <= rst_i ? 0 : f_pixels + (pixel_valid_o & pixel_ready_i);
    end
    wire f_asks_it = f_asked & f_asks == f_number;
    wire f_shows   = pixel_valid_o & f_pixels == f_number;

    // The first slot after a reset, where it has a primary that need not wait for what is of the other eye.
    reg        f_any;
    reg  [1:0] f_first_q;
    wire       f_first = f_new & ~f_any & slot_primary_i & ~single_i;
    always @(posedge clk_i) begin
        f_any     <= ~rst_i & (f_any | f_new);
        f_first_q <= {2{~rst_i}} & {f_first_q[0], f_first};
    end

    always @(posedge clk_i) if (f_begun & ~rst_i) begin
        // A request that waits is offered again, unchanged.
        p_request_stable: assert (`SAM_WAITS(request_valid_o, request_ready_i, {request_eye_o, request_x_o, request_y_o}));
        // What leaves of an eye has come before.
        p_nothing_made: assert (f_left + f_leaves_first + f_leaves_other <= f_all);
        // The pixels of an eye leave in the order in which they came, as they came; one that is lost shows as
        // the next one leaves in its place. (Until the depth test first drops a pixel.)
        p_order: assert (f_dropped | ~(f_leaves_first | f_leaves_other) | f_left != f_number
                         | (f_leaves_first ? f_left_first : f_left_other) == {f_pixel[F-1:1], f_leaves_first ? 1'b0 : out_blended_o});
        // Secondaries are read in the order in which they came, each where it is,
        p_asks: assert (~f_asked | f_asks != f_number
                        | (f_seconds + f_comes_second > f_asks & {request_eye_o, request_x_o, request_y_o} == f_at));
        // and not while an earlier pixel of its eye is under way to the same place (until the depth test
        // first drops a pixel).
        p_one_place: assert (f_dropped | ~f_asks_it | f_at != {f_eye, f_place} | f_before == f_left_there);
        // A pixel goes to blend with the background and the colour of its own read.
        p_pixel: assert (~f_shows | {pixel_rgba_o, pixel_area_o, pixel_background_o} == {f_rgba, f_area, f_answer[D +: `SAM_RGB_BITS]});
        // It is visible where it is nearer than what is there.
        p_depth: assert (~f_shows | DEPTH_EXTERNAL == 1 | pixel_visible_o == (f_depth < f_answer[0 +: D]));
        // The first primary passes at once, or, by the buffers of a long queue, in two clocks.
        p_passes: assert (~(SHORT ? f_first : f_first_q[1]) | (out_valid_o & out_primary_o));
    end
    // What is under way at most: told of the smallest queue alone, as it takes too many clocks to fill others.
    generate
        if (SLOTS == 2) begin : g_f_filled
            always @(posedge clk_i) if (f_begun & ~rst_i) begin
                // Of two slots: no more reads are under way than there are slots.
                p_reads: assert (f_reads <= SLOTS);
                // Of two slots: no more than the slots, the stages round them and the slot in front are under way.
                // (Until the depth test first drops a pixel.)
                p_nothing_lost: assert (f_dropped | f_all - f_left <= SLOTS + 4);
            end
        end
    endgenerate
`endif
endmodule

`default_nettype wire
