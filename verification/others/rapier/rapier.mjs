// Rapier 3-D, deterministic build (WebAssembly, float). Settings: dt; iterations; inner (internal iterations); slop and
// prediction (m); frequency (of contacts, 1/s); box (1: native boxes)
import R from "@dimforge/rapier3d-deterministic-compat";
import { runScenes } from "../scene.mjs";

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

function makeWorld(scene) {
  const world = new R.World(xyz([0, 0, 0])), parameters = world.integrationParameters;
  parameters.dt = scene.setting("dt", 0.002);
  parameters.numSolverIterations = scene.setting("iterations", 4);
  parameters.numInternalPgsIterations = scene.setting("inner", 1);
  parameters.normalizedAllowedLinearError = scene.setting("slop", 0.001);
  parameters.normalizedPredictionDistance = scene.setting("prediction", 0.002);
  parameters.contact_natural_frequency = scene.setting("frequency", 30);
  const bodies = scene.blocks.map((block) => addBlock(world, scene, block));
  const pushed = scene.blocks.flatMap((block, i) => (scene.forces[block.name] ? [[bodies[i], scene.forces[block.name]]] : []));
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
    },
    motion(i) {
      const q = bodies[i].rotation();
      return { centre: triple(bodies[i].translation()), turn: [q.w, q.x, q.y, q.z], velocity: triple(bodies[i].linvel()),
        spin: triple(bodies[i].angvel()) };
    },
    free() { world.free(); },
  };
}

await R.init();
await runScenes(makeWorld);
