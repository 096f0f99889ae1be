/* A kernel of the plainest kind, to begin from: separating axes over face normals and products of edges, and as the
 * point the mean of the overlap's corners, by trying all planes three by three. No hurry: see the README for its times. */
#include <math.h>
#include <stddef.h>

#include "voussoir_kernel.h"

enum { most = 128 }; /* planes of both blocks */
static const double nearly = 1e-9, parallel = 1e-12;

static double dot(const double* a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
static void cross(const double* a, const double* b, double* c) {
  for (int k = 0; k < 3; ++k) c[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}
static void turn(const voussoir_pose* pose, const double* x, double* y) {
  for (int k = 0; k < 3; ++k) y[k] = dot(pose->rotation + 3 * k, x);
}

/* the furthest vertex along a direction of the first block's axes; pose NULL: the first block itself */
static double reach(const voussoir_block* b, const voussoir_pose* pose, const double* n) {
  double best = -INFINITY, y[3];
  for (int v = 0; v < b->vertex_count; ++v) {
    const double* x = b->vertices + 3 * v;
    if (pose) turn(pose, x, y);
    const double r = dot(pose ? y : x, n);
    if (r > best) best = r;
  }
  return pose ? best + dot(pose->position, n) : best;
}

/* keeps the axis if the translation along it is the smallest so far; both senses of an edge product are axes */
static void try_axis(const voussoir_block* a, const voussoir_block* b, const voussoir_pose* pose, const double* axis,
                     voussoir_answer* best) {
  const double length = sqrt(dot(axis, axis));
  if (length < nearly) return;
  const double n[3] = {axis[0] / length, axis[1] / length, axis[2] / length}, back[3] = {-n[0], -n[1], -n[2]};
  const double depth = reach(a, NULL, n) + reach(b, pose, back);
  if (depth >= best->overlap) return;
  best->overlap = depth;
  for (int k = 0; k < 3; ++k) best->normal[k] = n[k];
}

/* the mean of the corners of the region within all planes */
static void middle(const double (*p)[4], int count, double* mean) {
  int found = 0;
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < i; ++j)
      for (int k = 0; k < j; ++k) {
        double ij[3], jk[3], ki[3], x[3];
        cross(p[i], p[j], ij), cross(p[j], p[k], jk), cross(p[k], p[i], ki);
        const double det = dot(ij, p[k]);
        if (fabs(det) < parallel) continue;
        for (int c = 0; c < 3; ++c) x[c] = (p[k][3] * ij[c] + p[i][3] * jk[c] + p[j][3] * ki[c]) / det;
        int inside = 1;
        for (int m = 0; m < count && inside; ++m) inside = dot(p[m], x) <= p[m][3] + nearly;
        for (int c = 0; c < 3 && inside; ++c) mean[c] = (mean[c] * found + x[c]) / (found + 1);
        found += inside;
      }
}

int32_t voussoir_kernel_version(void) { return VOUSSOIR_KERNEL_VERSION; }
const char* voussoir_kernel_name(void) { return "example (separating axes)"; }

int32_t voussoir_contact(const void* first, const void* second, const voussoir_pose* pose, int32_t asked,
                         voussoir_answer* answer) {
  const voussoir_block *a = first, *b = second;
  const int count = a->plane_count + b->plane_count;
  double p[most][4], axis[3];
  if (count > most) return 1;
  for (int i = 0; i < a->plane_count; ++i)
    for (int k = 0; k < 4; ++k) p[i][k] = a->planes[4 * i + k];
  for (int i = 0; i < b->plane_count; ++i) {
    double* n = p[a->plane_count + i];
    turn(pose, b->planes + 4 * i, n);
    n[3] = b->planes[4 * i + 3] + dot(n, pose->position);
  }
  answer->overlap = INFINITY;
  for (int i = 0; i < count; ++i) {
    for (int k = 0; k < 3; ++k) axis[k] = i < a->plane_count ? p[i][k] : -p[i][k];
    try_axis(a, b, pose, axis, answer);
  }
  /* edges follow from pairs of planes; a pair without an edge does no harm but cost */
  for (int i = 0; i < a->plane_count && answer->overlap > 0; ++i)
    for (int j = 0; j < i; ++j)
      for (int k = a->plane_count; k < count; ++k)
        for (int l = a->plane_count; l < k; ++l) {
          double e[3], f[3];
          cross(p[i], p[j], e), cross(p[k], p[l], f), cross(e, f, axis);
          try_axis(a, b, pose, axis, answer);
          for (int c = 0; c < 3; ++c) axis[c] = -axis[c];
          try_axis(a, b, pose, axis, answer);
        }
  answer->touch = answer->overlap > 0;
  if (!answer->touch || asked == VOUSSOIR_DECISION) return 0;
  middle((const double(*)[4])p, count, answer->point);
  answer->has_point = answer->has_normal = 1;
  answer->overlap_kind = VOUSSOIR_SMALLEST_TRANSLATION;
  return 0;
}
