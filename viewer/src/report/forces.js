// What the joints carry in a frame of the blocks' records: of each joint the sum of its normal and shear forces, and the
// largest share of its friction that a contact mobilises.
import { TRIAL } from '../data.js';

// the last frame that is no rejected trial of a search: the last equilibrium, or the end of the run
export const lastState = (run) => run.frames.findLastIndex((frame) => frame.kind !== TRIAL);
// the last rejected trial; -1: there is none
export const lastTrial = (run) => run.frames.findLastIndex((frame) => frame.kind === TRIAL);

export function jointForces(run, frame) {
  const { contacts } = run.frames[frame], sums = new Map();
  for (let i = 0; i < contacts.count; ++i) {
    const joint = run.pairs.joint[contacts.pair[i]];
    const row = sums.get(joint) ?? { name: run.head.joints[joint]?.name ?? 'faces that no joint made', contacts: 0, normal: 0, shear: 0, friction: 0 };
    const size = Math.hypot(...contacts.force.map((column) => column[i])), normal = contacts.normal[i];
    row.contacts += 1;
    row.normal += normal;
    row.shear += Math.sqrt(Math.max(0, size * size - normal * normal));
    row.friction = Math.max(row.friction, contacts.friction[i]);
    sums.set(joint, row);
  }
  return [...sums.values()].sort((a, b) => b.normal - a.normal);
}
