// The report on a kinematic analysis of a rock face: two nets with its zones, their counts, and beside them what block
// theory says of the pairs of joints, since the overlay is safe on neither side.
import { digits, listColour } from '../colours.js';
import { poleWith } from './net.js';
import { bullets, header, paragraph, section } from './parts.js';
import { jointNets, orientation, scanlineChoice, slidingLines, slidingPoles, weightedZones, withProjection } from './stereonets.js';
import { element, list, readCsv, table } from './table.js';

const MOST_PAIRS = 25;

function worstPairs(csv) {
  const { head, rows } = readCsv(csv), at = (row, name) => row[head.indexOf(name)];
  const judged = rows.filter((row) => at(row, 'factor') !== '').sort((a, b) => Number(at(a, 'factor')) - Number(at(b, 'factor')));
  return { judged: judged.length, table: table(['joint', 'joint', 'line (plunge/trend)', 'zone of the line', 'motion of the block', 'direction (plunge/trend)', 'factor of safety'],
    judged.slice(0, MOST_PAIRS).map((row) => [at(row, 'joint_a'), at(row, 'joint_b'), orientation({ dip: Number(at(row, 'line_plunge_deg')), direction: Number(at(row, 'line_trend_deg')) }), at(row, 'zone'), at(row, 'motion'),
      orientation({ dip: Number(at(row, 'direction_plunge_deg')), direction: Number(at(row, 'direction_trend_deg')) }), digits(Number(at(row, 'factor')))]), { numbers: [6] }) };
}

export function kinematicSections({ kinematics, files, block }) {
  const names = [...new Set(kinematics.joints.map((joint) => joint.set))];
  const sets = names.map((name, k) => ({ name, colour: listColour(k), poles: kinematics.joints.filter((joint) => joint.set === name).map((joint) => poleWith(joint.normal)) }));
  const { face_dip_deg: dip, face_direction_deg: direction, friction_deg: friction, limits_deg: limits } = kinematics;
  const request = { face: { dip, direction }, friction, limits: { plane: limits.plane_sliding, flexural: limits.flexural_toppling, direct: limits.direct_toppling } };
  const pairs = worstPairs(files.pairs), scanline = scanlineChoice();
  return [
    header(kinematics.title || 'Kinematic analysis', block, { class: '', text: `Kinematic analysis of ${kinematics.joints.length} joints: face ${orientation(request.face)} (dip/dip direction), friction ${friction}°.` }),
    section('Joints', jointNets(sets, scanline)),
    section('Zones of the face', table(['mode', 'count', 'of', 'share (%)'], kinematics.counts.map((row) => [row.mode, row.count, row.of, row.of > 0 ? digits((100 * row.count) / row.of) : '']), { numbers: [1, 2, 3], caption: 'A screen of directions' }),
      withProjection(sets, scanline, (kind, chosen) => [slidingPoles(chosen, request, kind), weightedZones(chosen, request), slidingLines(chosen, request, kind)])),
    section('What block theory says of the pairs', paragraph('The block above both planes, under weight and friction alone. The overlay is safe on neither side: pairs outside the primary zone may slide with a factor below 1, and pairs inside it may stand.'),
      table(['pairs whose line leaves the face', 'F < 1', 'F ≥ 1', 'no block above both planes'], kinematics.pairs.map((row) => [row.zone, row.below_one, row.at_least_one, row.buried]), { numbers: [1, 2, 3] }),
      pairs.judged ? paragraph(`The lowest ${Math.min(MOST_PAIRS, pairs.judged)} of ${pairs.judged} factors:`) : null, pairs.judged ? pairs.table : null),
    section('Assumptions', bullets(['Directions only: neither places and sizes of the joints, nor water, cohesion, supports, earthquake or stress are counted.',
      `All joints have one friction angle, ${friction}°.`, 'The lateral limits are usual ones, a choice of this analysis.',
      'Sampling along a line or a face misses joints that are nearly parallel to it: counts are not corrected for that, unless the reader states a scanline above. Counts of lines of intersection never are.'])),
    section('How it was made', list([['program', kinematics.program], ['input', kinematics.input_hash]]),
      element('pre', {}, `voussoir blocks SCENE --kinematics --face ${dip}/${direction} --friction ${friction}`)),
  ];
}
