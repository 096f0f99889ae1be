#pragma once

#include <vector>

// A slide in the plane on a surface that bends, cut by one cross joint at each bend, by limit equilibrium: the blocks
// translate along the slide, the cross joints between them are fully mobilised. SI units per metre of slope, radians.
//
// The force from block to block is at an angle delta below the horizontal, downslope: delta = phi_c + pi/2 - beta,
// phi_c the cross joints' friction angle, beta their dip into the slope (pi/2: vertical). A block under the vertical
// force W and the horizontal force H, downslope, on a slide of dip alpha and friction phi adds to the horizontal part
// of that force
//
//   E_out - E_in = (H + W tan(alpha - phi))/(1 + tan(delta) tan(alpha - phi)),
//
// and at the critical friction the sum over all blocks vanishes: no force at the head, none at the toe. Rigid-block
// limit analysis, whose joints open as they slip, finds the same if the blocks translate, as they do behind vertical
// joints; joints parallel to those at the bends change nothing, since they do not slip. If another mechanism needs more
// friction (cross joints that dip 50 degrees into the slope) this one is a lower bound of the angle.
namespace voussoir::reference {

struct SectionPoint {
  double x = 0, y = 0;  // m, downslope and elevation
};

struct SlideSection {
  std::vector<SectionPoint> outline;  // closed, counter-clockwise; its lower side is the slide
  std::vector<SectionPoint> slide;  // from head to toe, straight between: its bends are the second to the last but one
};

// The western section of the Vaiont slide (after Boon 2013, chapter 6): back 37.488297, middle 13.497070 degrees, and
// the seat, which dips `seat_dip` (rad, downslope) about the lower bend, the front of the slope prolonged to it.
SlideSection vaiont_section(double seat_dip = 0);

struct SectionLoads {
  double unit_weight = 23500;         // N/m^3
  std::vector<SectionPoint> table;    // the water's surface, left to right, straight between, level beyond; empty: dry
  double water_unit_weight = 9810;    // N/m^3
  double horizontal_coefficient = 0;  // of the weight, downslope
};

struct SectionBlock {
  double dip = 0;         // rad, of the slide below it
  double area = 0;        // m^2
  double vertical = 0;    // N/m, weight less the water's lift, downwards
  double horizontal = 0;  // N/m, downslope: by the water, if its surface falls, and by the coefficient
};

// The blocks from head to toe. One water acts on all faces of all blocks: its force is gamma_w times the submerged area
// below each straight piece of its surface, up and against the surface's gradient. Throws std::invalid_argument on
// fewer than two points of the slide, a table out of order, a dip out of range.
std::vector<SectionBlock> section_blocks(const SlideSection& section, const SectionLoads& loads,
                                         double cross_dip = 1.5707963267948966);

struct SectionFriction {
  double slide = 0, cross = 0;            // rad
  double cross_dip = 1.5707963267948966;  // rad, into the slope; as given to section_blocks
};

// Horizontal part of the force from each block to the next (N/m, compression positive); the last one is the force
// needed to hold the toe.
std::vector<double> section_forces(const std::vector<SectionBlock>& blocks, const SectionFriction& friction);

// The friction angle of the slide at which the last force vanishes. Throws std::invalid_argument if none of 0 to the
// steepest dip does.
double critical_slide_friction(const std::vector<SectionBlock>& blocks, double cross, double cross_dip);

// The coefficient at which `blocks`, under their own weights, are just stable when that fraction of their weights also
// acts downslope.
double critical_horizontal_coefficient(const std::vector<SectionBlock>& blocks, const SectionFriction& friction);

// The factor by which both tangents may be divided; below one if the slide is unstable.
double section_factor_of_safety(const std::vector<SectionBlock>& blocks, const SectionFriction& friction);

}  // namespace voussoir::reference
