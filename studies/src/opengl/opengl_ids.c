/* Draws triangles given in window coordinates with OpenGL (OSMesa), says how long it took, and writes
 * which one is seen at every pixel. No projection of its own: what is compared is rasterisation and
 * depth test.
 *
 * OpenGL counts rows upward. Row 0 is taken for the top one here, and so the rule by which the left
 * and lower sides of OpenGL's triangles own their pixels is the top-left rule.
 *
 * OpenGL clips at the edge of its viewport and so moves the sides of what it has cut. The viewport is
 * therefore wider by a margin on all sides, and a scissor leaves the window of it.
 *
 * opengl_ids WIDTH HEIGHT MARGIN ROUNDS < triangles > ids
 * in:  per triangle three times x, y, depth as floats (pixels from the window's top left, depth 0 to 1)
 * out: per pixel, rows from the top, 32 bits: 1 + index of the triangle, 0 background
 * err: renderer and subpixel bits; seconds of the shortest of the rounds
 */
#define _POSIX_C_SOURCE 199309L
#include <GL/osmesa.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static double now(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return time.tv_sec + time.tv_nsec * 1e-9;
}

/* Reads all of the input into arrays for OpenGL; returns the number of triangles. */
static unsigned read_triangles(const int wide[2], int margin, float **places, unsigned char **colours) {
    unsigned count = 0, room = 0;
    float corners[9];
    while (fread(corners, sizeof corners, 1, stdin) == 1) {
        if (count == room) {
            room = room ? 2 * room : 4096;
            *places = realloc(*places, room * sizeof corners);
            *colours = realloc(*colours, (size_t)room * 12);
            if (!*places || !*colours) exit(4);
        }
        for (int k = 0; k < 3; k++) {
            float *place = *places + 9 * (size_t)count + 3 * k;
            unsigned char *colour = *colours + 12 * (size_t)count + 4 * k;
            unsigned id = count + 1;
            for (int axis = 0; axis < 2; axis++)
                place[axis] = (float)(2.0 * ((double)corners[3 * k + axis] + margin) / wide[axis] - 1.0);
            place[2] = (float)(2.0 * (double)corners[3 * k + 2] - 1.0);
            memcpy(colour, (unsigned char[]){id & 255, id >> 8 & 255, id >> 16 & 255, 255}, 4);
        }
        count++;
    }
    return count;
}

int main(int argc, char **argv) {
    int argument[4] = {0};
    for (int n = 0; n < 4 && n + 1 < argc; n++) argument[n] = atoi(argv[n + 1]);
    const int width = argument[0], height = argument[1], margin = argument[2], rounds = argument[3];
    const int wide[2] = {width + 2 * margin, height + 2 * margin};
    const int attributes[] = {OSMESA_FORMAT, OSMESA_RGBA, OSMESA_DEPTH_BITS, 24, OSMESA_PROFILE,
                              OSMESA_COMPAT_PROFILE, 0};
    OSMesaContext context = OSMesaCreateContextAttribs(attributes, NULL);
    unsigned char *pixels = calloc((size_t)wide[0] * wide[1], 4);
    if (!context || !pixels || !OSMesaMakeCurrent(context, pixels, GL_UNSIGNED_BYTE, wide[0], wide[1])) {
        fprintf(stderr, "no OpenGL context of %d x %d\n", wide[0], wide[1]);
        return 3;
    }
    GLint subpixel_bits = 0;
    glGetIntegerv(GL_SUBPIXEL_BITS, &subpixel_bits);
    fprintf(stderr, "%s, %d subpixel bits\n", (const char *)glGetString(GL_RENDERER), (int)subpixel_bits);
    glViewport(0, 0, wide[0], wide[1]);
    glScissor(margin, margin, width, height);
    glEnable(GL_SCISSOR_TEST);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glDisable(GL_DITHER);
    glShadeModel(GL_FLAT);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glClearDepth(1.0);
    float *places = NULL;
    unsigned char *colours = NULL;
    unsigned count = read_triangles(wide, margin, &places, &colours);
    glEnableClientState(GL_VERTEX_ARRAY);
    glEnableClientState(GL_COLOR_ARRAY);
    glVertexPointer(3, GL_FLOAT, 0, places);
    glColorPointer(4, GL_UNSIGNED_BYTE, 0, colours);
    double best = 1e9;
    for (int round = 0; round < rounds; round++) {
        double start = now();
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        glDrawArrays(GL_TRIANGLES, 0, 3 * (GLsizei)count);
        glFinish();
        double seconds = now() - start;
        if (seconds < best) best = seconds;
    }
    fprintf(stderr, "%.9f\n", best);
    for (int y = 0; y < height; y++) {
        unsigned char *row = pixels + 4 * ((size_t)(y + margin) * wide[0] + margin);
        for (int x = 0; x < width; x++) row[4 * x + 3] = 0;
        fwrite(row, 4, width, stdout);
    }
    OSMesaDestroyContext(context);
    return 0;
}
