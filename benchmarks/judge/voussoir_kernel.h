/* A contact kernel of your own, judged and timed: build a shared library that exports the functions below, then
 * `make judge-kernel KERNEL=./mine.so` (README.md). C99; lengths in m; frames are right-handed. */
#ifndef VOUSSOIR_KERNEL_H
#define VOUSSOIR_KERNEL_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define VOUSSOIR_KERNEL_VERSION 1

/* A convex block in axes of its own, whose origin is inside. A point x is in the block if n·x <= d for each plane. */
typedef struct {
  int32_t plane_count;
  int32_t vertex_count;
  const double* planes;   /* plane_count times n (3 numbers, unit, outward), d (m) */
  const double* vertices; /* vertex_count times 3, m, where the planes intersect; to rounding */
} voussoir_block;

/* x of the block -> rotation x + position, m. Rows one after the other. */
typedef struct {
  double rotation[9];
  double position[3];
} voussoir_pose;

/* what is asked */
enum { VOUSSOIR_DECISION = 0, VOUSSOIR_CONTACT = 1 };

/* the overlap's definition: the smallest translation that separates the blocks; twice the depth of the deepest point
 * under all planes; or the length of the overlap along the kernel's own normal through its own point */
enum { VOUSSOIR_NO_OVERLAP = 0, VOUSSOIR_SMALLEST_TRANSLATION = 1, VOUSSOIR_DEEPEST_POINT = 2, VOUSSOIR_ALONG_NORMAL = 3 };

/* In the axes of the first block. Point, normal and overlap are read only if the blocks touch, a contact was asked and
 * their flag is set; the judge clears the struct before each call. */
typedef struct {
  int32_t touch;        /* 1: the blocks have a common interior point */
  int32_t has_point;    /* 1: point is given */
  int32_t has_normal;   /* 1: normal is given */
  int32_t overlap_kind; /* VOUSSOIR_NO_OVERLAP: overlap is not given */
  double point[3];      /* m, in both blocks */
  double normal[3];     /* unit, from the first block to the second */
  double overlap;       /* m, positive */
} voussoir_answer;

/* VOUSSOIR_KERNEL_VERSION of the header it was built with; compulsory */
int32_t voussoir_kernel_version(void);

/* a name and version for the tables; compulsory */
const char* voussoir_kernel_name(void);

/* A handle for a block, made once and passed with every query; the block's arrays live until it is released. NULL means
 * failure and ends the judging. Optional: without both, the handle is the address of the voussoir_block. */
const void* voussoir_prepare(const voussoir_block* block);
void voussoir_release(const void* handle);

/* Two blocks, the second by its pose in the axes of the first. 0: answered; another number: failed, counted as an
 * error. Compulsory. Calls come from one thread, with no memory of the call before. */
int32_t voussoir_contact(const void* first, const void* second, const voussoir_pose* pose, int32_t asked,
                         voussoir_answer* answer);

#ifdef __cplusplus
}
#endif
#endif
