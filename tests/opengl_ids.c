/* Draws triangles given in window coordinates with OpenGL (OSMesa) and writes which one is seen at
 * every pixel. No projection of its own: what is compared is rasterisation and depth test.
 *
 * OpenGL counts rows upward. Row 0 is taken for the top one here, and so the rule by which the left
 * and lower sides of OpenGL's triangles own their pixels is the top-left rule.
 *
 * opengl_ids WIDTH HEIGHT < triangles > ids
 * in:  per triangle three times x, y, depth as floats (pixels from the top left, depth 0 to 1)
 * out: per pixel, rows from the top, 32 bits: 1 + index of the triangle, 0 background
 */
#include <GL/osmesa.h>
#include <stdio.h>
#include <stdlib.h>

int main(int argc, char **argv) {
    int width = argc > 2 ? atoi(argv[1]) : 0, height = argc > 2 ? atoi(argv[2]) : 0;
    const int attributes[] = {OSMESA_FORMAT, OSMESA_RGBA, OSMESA_DEPTH_BITS, 24, OSMESA_PROFILE,
                              OSMESA_COMPAT_PROFILE, 0};
    OSMesaContext context = OSMesaCreateContextAttribs(attributes, NULL);
    unsigned char *pixels = calloc((size_t)width * height, 4);
    if (!context || !pixels || !OSMesaMakeCurrent(context, pixels, GL_UNSIGNED_BYTE, width, height)) {
        fprintf(stderr, "no OpenGL context of %d x %d\n", width, height);
        return 3;
    }
    GLint subpixel_bits = 0;
    glGetIntegerv(GL_SUBPIXEL_BITS, &subpixel_bits);
    fprintf(stderr, "%s, %d subpixel bits\n", (const char *)glGetString(GL_RENDERER), (int)subpixel_bits);
    glViewport(0, 0, width, height);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glDisable(GL_DITHER);
    glShadeModel(GL_FLAT);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glClearDepth(1.0);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    float corner[9];
    glBegin(GL_TRIANGLES);
    for (unsigned id = 1; fread(corner, sizeof corner, 1, stdin) == 1; id++) {
        glColor4ub(id & 255, id >> 8 & 255, id >> 16 & 255, 255);
        for (int k = 0; k < 3; k++) {
            double x = corner[3 * k], y = corner[3 * k + 1], z = corner[3 * k + 2];
            glVertex3d(2.0 * x / width - 1.0, 2.0 * y / height - 1.0, 2.0 * z - 1.0);
        }
    }
    glEnd();
    glFinish();
    for (size_t n = 0; n < (size_t)width * height; n++) pixels[4 * n + 3] = 0;
    fwrite(pixels, 4, (size_t)width * height, stdout);
    OSMesaDestroyContext(context);
    return 0;
}
