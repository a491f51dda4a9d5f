/* cc hair_of_a_package.c $(pkg-config --cflags --libs whorl-procedural) && ./a.out head.groom */
#include <stdio.h>
#include <whorl_procedural.h>

/* Takes one block of hair. A renderer's plug-in hands it over to the renderer here. */
static int take(const WhorlHair *hair, void *user) {
    double *tips = user; /* sum of their heights, number */
    const float *position = hair->positions;
    for (uint64_t i = 0; i < hair->hairs; ++i) {
        uint32_t vertices = hair->vertex_counts[i];
        tips[0] += position[3 * (vertices - 1) + 1];
        tips[1] += 1;
        position += 3 * vertices;
    }
    return 0; /* go on */
}

int main(int count, char **words) {
    WhorlGroom *groom;
    WhorlError error;
    WhorlRequest request = WHORL_REQUEST_INIT;
    WhorlStatus status = whorl_open(count > 1 ? words[1] : "", NULL, &groom, &error);
    double tips[2] = {0, 0};
    for (; status == WHORL_OK && request.part < whorl_part_count(groom); ++request.part) {
        float b[6];
        status = whorl_box(groom, &request, b, &error);
        if (status != WHORL_OK) break;
        printf("part %u: x %g to %g, y %g to %g, z %g to %g\n", (unsigned)request.part, b[0], b[1], b[2], b[3], b[4], b[5]);
        status = whorl_stream(groom, &request, take, tips, &error);
    }
    if (status == WHORL_OK) printf("%.0f hairs, tips %g m high on average\n", tips[1], tips[0] / tips[1]);
    else fprintf(stderr, "%s\n", error.text);
    whorl_close(groom);
    return status == WHORL_OK ? 0 : 1;
}
