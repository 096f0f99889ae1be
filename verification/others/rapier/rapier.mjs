// Rapier 3-D, deterministic build (WebAssembly, float). Settings: dt; iterations; inner (internal iterations); slop and
// prediction (m); frequency (of contacts, 1/s); box (1: native boxes)
import R from "@dimforge/rapier3d-deterministic-compat";
import { breaks, rodsOf, runScenes } from "../scene.mjs";

const xyz = ([x, y, z]) => ({ x, y, z });
const triple = ({ x, y, z }) => [x, y, z];

function addBlock(world, scene, block) {
  const [w, x, y, z] = block.turn;
  const description = (block.fixed ? R.RigidBodyDesc.fixed() : R.RigidBodyDesc.dynamic())
    .setTranslation(...block.centre).setRotation({ w, x, y, z }).setLinvel(...block.velocity).setAngvel(xyz(block.spin))
    .setCanSleep(false).setLinearDamping(0).setAngularDamping(0);
  const body = world.createRigidBody(description);
  const native = scene.setting("box", 1) && block.box;
  const shape = native ? R.ColliderDesc.cuboid(...block.box.map((length) => length / 2))
                       : R.ColliderDesc.convexHull(new Float32Array(block.vertices.flat()));
  // Min: a coefficient is used as it is; the rule left alone is the mean of both bodies
  shape.setFriction(scene.friction).setFrictionCombineRule(R.CoefficientCombineRule.Min).setRestitution(0)
    .setContactSkin(0).setMassProperties(block.mass, xyz([0, 0, 0]), xyz(block.moments), { x: 0, y: 0, z: 0, w: 1 });
  world.createCollider(shape, body);
  return body;
}

function addWeld(world, weld, bodyOf) {
  return rodsOf(weld).map((rod) => {
    const spring = R.JointData.spring(1, rod.stiffness, rod.damping, xyz(rod.onFixed), xyz(rod.onBlock));
    const joint = world.createImpulseJoint(spring, bodyOf(weld.fixed), bodyOf(weld.block), true);
    joint.setContactsEnabled(false);
    return joint;
  });
}

function makeWorld(scene) {
  const world = new R.World(xyz([0, 0, 0])), parameters = world.integrationParameters;
  parameters.dt = scene.setting("dt", 0.002);
  parameters.numSolverIterations = scene.setting("iterations", 4);
  parameters.numInternalPgsIterations = scene.setting("inner", 1);
  parameters.normalizedAllowedLinearError = scene.setting("slop", 0.001);
  parameters.normalizedPredictionDistance = scene.setting("prediction", 0.002);
  parameters.contact_natural_frequency = scene.setting("frequency", 30);
  const bodies = scene.blocks.map((block) => addBlock(world, scene, block));
  const bodyOf = (block) => bodies[scene.blocks.indexOf(block)];
  const bonds = scene.welds.map((weld) => addWeld(world, weld, bodyOf));
  const pushed = scene.blocks.flatMap((block, i) => (scene.forces[block.name] ? [[bodies[i], scene.forces[block.name]]] : []));
  const motionOf = (body) => {
    const q = body.rotation();
    return { centre: triple(body.translation()), turn: [q.w, q.x, q.y, q.z], velocity: triple(body.linvel()), spin: triple(body.angvel()) };
  };
  return {
    step(gravity, share) {
      world.gravity = xyz(gravity);
      for (const [body, force] of pushed) {
        const present = force.map((x) => share * x);
        body.resetForces(true);  // the engine keeps them from step to step
        body.resetTorques(true);
        body.addForce(xyz(present.slice(0, 3)), true);
        body.addTorque(xyz(present.slice(3)), true);
      }
      world.step();
      scene.welds.forEach((weld, k) => {
        if (!breaks(weld, motionOf(bodyOf(weld.block)))) return;
        bonds[k].splice(0).forEach((joint) => world.removeImpulseJoint(joint, true));
      });
    },
    motion: (i) => motionOf(bodies[i]),
    free() { world.free(); },
  };
}

await R.init();
await runScenes(makeWorld);
