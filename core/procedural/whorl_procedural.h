/* SPDX-License-Identifier: Apache-2.0 */
/* libwhorl_procedural: the hair of a Whorl package, made at render time. Plain C99, also for C++. */
#ifndef WHORL_PROCEDURAL_H
#define WHORL_PROCEDURAL_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Open a package, ask for the box of each part, and make a part when the renderer needs it:
 *
 *     WhorlGroom *groom;
 *     WhorlError error;
 *     if (whorl_open("head.groom", NULL, &groom, &error) != WHORL_OK) { report(error.text); return; }
 *     WhorlRequest request = WHORL_REQUEST_INIT;
 *     for (request.part = 0; request.part < whorl_part_count(groom); ++request.part)
 *         whorl_stream(groom, &request, draw, renderer, &error);
 *     whorl_close(groom);
 *
 * Hair:      Catmull-Rom curves through all of their vertices, the first and the last included; a renderer that draws
 *            only between the middle two of four vertices gets the first and the last one twice. Widths are diameters.
 * Units:     metres, seconds, linear colour, in the space of the mesh that the hair grows on, Y up.
 * Sameness:  the same package, request and version give the same bytes in any order, in any number of threads and
 * parts, in blocks of any size and on any processor. Parts 0 to n - 1 in order are the whole, hair by hair. Threads:
 * any number of calls at once on one WhorlGroom, but for whorl_close. Nothing is shared between two of them. Faults:
 * every function that can fail returns a status and, when `error` is not NULL, one sentence. Nothing is printed, no
 * signal, exit or C++ exception leaves the library; too little memory is a status as well. Structs:   begin with
 * struct_size; the _INIT macros set it. A newer library serves programs built with an older header of the same major
 * version.
 */

#define WHORL_API_MAJOR 1
#define WHORL_API_MINOR 0

#if defined(__GNUC__)
#define WHORL_API __attribute__((visibility("default")))
#else
#define WHORL_API
#endif

typedef enum WhorlStatus {
    WHORL_OK = 0,
    WHORL_BAD_ARGUMENT = 1, /* the call makes no sense: NULL, no such part, an unknown parameter */
    WHORL_BAD_FILE = 2,     /* missing, damaged, of a newer version; what to do is in the sentence */
    WHORL_NO_MEMORY = 3,
    WHORL_BAD_SIZE = 4, /* the buffers do not have the size of the hair */
    WHORL_STOPPED = 5   /* the callback asked for it */
} WhorlStatus;

/* Always ends in a zero; a sentence that is too long is cut. Untouched by calls that succeed. */
typedef struct WhorlError {
    char text[512];
} WhorlError;

typedef struct WhorlGroom WhorlGroom;

/* Major * 65536 + minor of the interface of the loaded library. Same major as WHORL_API_MAJOR: go on. */
WHORL_API uint32_t whorl_version(void);
/* "0.1.0": of Whorl as a whole. */
WHORL_API const char* whorl_version_text(void);

/* ---- Opening ---- */

/*
 * A NAME.groom folder or a NAME.whorl document, path in UTF-8. `overrides` (or NULL) is a JSON object of parameters to
 * change, by the names in Whorl's parameter reference:
 *
 *     {"counts/hairs": 200000, "groups/scalp/frizz/tip": 0.004, "groups/scalp/general/density/map": ""}
 *
 * What is not there or out of range is refused. All files are read now; they may be replaced or removed afterwards.
 * What all hair needs (the skin it keeps outside of, where it grows) is made at the first call that makes hair, by all
 * cores.
 */
WHORL_API WhorlStatus whorl_open(const char* path, const char* overrides, WhorlGroom** groom, WhorlError* error);
/* A document in memory: the bytes of a NAME.whorl file, which the editor hands over unsaved. Copied. */
WHORL_API WhorlStatus whorl_open_memory(const void* bytes, size_t size, const char* overrides, WhorlGroom** groom,
                                        WhorlError* error);
/* NULL is allowed. No other call may run. */
WHORL_API void whorl_close(WhorlGroom* groom);

/* ---- What is in it (never fail; 0 or NULL for what is not there) ---- */

/* Parts that the package was exported in; counts/parts of a document. Compact pieces of the surface, for the threads.
 */
WHORL_API uint32_t whorl_part_count(const WhorlGroom* groom);
/* Hairs asked for in the whole groom. About as many grow, times the hairs of a strand; whorl_count is exact. */
WHORL_API uint64_t whorl_hairs_asked(const WhorlGroom* groom);
WHORL_API uint32_t whorl_group_count(const WhorlGroom* groom);
/* UTF-8, until whorl_close. */
WHORL_API const char* whorl_group_name(const WhorlGroom* groom, uint32_t group);
/* 1 when the hair moves with time (animated frizz): only then motion samples differ. */
WHORL_API int whorl_is_animated(const WhorlGroom* groom);
/* Frames that the package was exported with; their boxes are stored. 0 when it has none, and then nothing is set. */
WHORL_API int whorl_frames(const WhorlGroom* groom, int32_t* first, int32_t* last, double* frames_per_second);
/* What was repaired or left out while opening, one sentence each. NULL beyond the last. */
WHORL_API const char* whorl_warning(const WhorlGroom* groom, uint32_t index);

/* ---- What to make ---- */

#define WHORL_MAX_TIMES 64

/* Flag: work in the calling thread alone; for renderers that call from all of theirs. */
#define WHORL_ONE_THREAD 1u

typedef struct WhorlRequest {
    size_t struct_size;
    uint32_t part;
    uint32_t part_count; /* 0: whorl_part_count. Any split gives the same hair; at most 4096. */
    float share; /* level of detail, 0 to 1: this share of the hairs, as much wider as they are fewer. The hairs of
                    a smaller share are all among those of a larger one, with the same ids. See below. */
    uint32_t flags;
    const float* times; /* motion samples, seconds (frame / frames_per_second); NULL: one at 0. Every sample has the
                           same hairs with the same number of vertices. */
    uint32_t time_count;
    uint32_t block_hairs; /* whorl_stream: most hairs in a block, and memory with it; 0: 4096. A strand stays whole. */
} WhorlRequest;

#define WHORL_REQUEST_INIT \
    { sizeof(WhorlRequest), 0, 0, 1.0f, 0, NULL, 0, 0 }

/* The share that gives about that number of hairs in the whole groom. */
WHORL_API float whorl_share_for_count(const WhorlGroom* groom, uint64_t hairs);
/* The share at which hairs are an eighth of a pixel wide where a metre has that many pixels; 1 where they are wider. */
WHORL_API float whorl_share_for_scale(const WhorlGroom* groom, float pixels_per_metre);
/* The same for a box (see whorl_box) that covers `pixels` of the picture: RenderMan's detail. */
WHORL_API float whorl_share_for_pixels(const WhorlGroom* groom, const float box[6], float pixels);

/* ---- Boxes and counts ---- */

/*
 * The smallest box around the rendered curves with their width, over all times of the request (a renderer moves hair
 * straight from sample to sample, which stays inside): xmin, xmax, ymin, ymax, zmin, zmax. With no hair xmin is above
 * xmax, and so on. Stored in the package for its own parts, full share, and time 0 or its frames; else the hair is
 * made.
 */
WHORL_API WhorlStatus whorl_box(const WhorlGroom* groom, const WhorlRequest* request, float box[6], WhorlError* error);

/* Exact number of curves and of their vertices in one motion sample. Stored like the box; else counted without making
   the hair, unless its group skips vertices. */
WHORL_API WhorlStatus whorl_count(const WhorlGroom* groom, const WhorlRequest* request, uint64_t* hairs,
                                  uint64_t* vertices, WhorlError* error);

/* ---- Hair ---- */

/* Arrays of n entries a hair, a vertex, or a vertex and motion sample (sample by sample). */
typedef struct WhorlHair {
    size_t struct_size;
    uint64_t hairs;
    uint64_t vertices;       /* of one motion sample */
    uint32_t* vertex_counts; /* a hair: its vertices, at least 2; they follow each other in hair order */
    float* positions;        /* 3 a vertex and sample */
    float* normals;          /* 3 a vertex and sample: unit, across the curve, without twist */
    float* widths;           /* 1 a vertex: diameter */
    float* colours;          /* 3 a vertex: red, green, blue; not multiplied by opacity */
    float* opacities;        /* 1 a vertex: 0 to 1 */
    float* root_uvs;         /* 2 a hair */
    uint32_t* ids;           /* 1 a hair: number in the whole groom, the same in any split; not without gaps */
    uint8_t* members;        /* 1 a hair: number in its strand; hairs of one strand share their id */
    uint8_t* groups;         /* 1 a hair: see whorl_group_name */
} WhorlHair;

#define WHORL_HAIR_INIT \
    { sizeof(WhorlHair), 0, 0, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL }

/* Fills the arrays that are not NULL. `hairs` and `vertices` must be what whorl_count says for the same request;
   otherwise WHORL_BAD_SIZE, and the arrays hold anything. */
WHORL_API WhorlStatus whorl_fill(const WhorlGroom* groom, const WhorlRequest* request, const WhorlHair* hair,
                                 WhorlError* error);

/* Takes one block; all arrays are there, to be read during the call only. Other than 0: stop. Called from the thread
   that called whorl_stream. May call any function of this library, but not leave with longjmp or an exception. */
typedef int (*WhorlSink)(const WhorlHair* block, void* user);

/* The same hair in blocks, in the same order, without counting first and with the memory of a block. */
WHORL_API WhorlStatus whorl_stream(const WhorlGroom* groom, const WhorlRequest* request, WhorlSink sink, void* user,
                                   WhorlError* error);

/* One number for all bytes of the hair at its first time: what `whorl-cli hash` prints, for part 0 of 1. */
WHORL_API WhorlStatus whorl_digest(const WhorlGroom* groom, const WhorlRequest* request, uint64_t* digest,
                                   WhorlError* error);

#ifdef __cplusplus
}
#endif

#endif
