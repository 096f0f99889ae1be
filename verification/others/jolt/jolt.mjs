// Jolt (WebAssembly, float). Settings: dt; iterations (of velocities); positions (iterations); radius (m, of rounded
// edges within a shape); slop and speculative (m); baumgarte; box (1: native boxes)
import init from "jolt-physics/wasm-compat";
import { breaks, rodsOf, runScenes } from "../scene.mjs";

const J = await init();
const vector = (a) => new J.Vec3(...a);
const triple = (a) => [a.GetX(), a.GetY(), a.GetZ()];

function makeSystem(scene) {
  const settings = new J.JoltSettings();
  const pairs = new J.ObjectLayerPairFilterTable(3), layers = new J.BroadPhaseLayerInterfaceTable(3, 2);
  pairs.EnableCollision(0, 1);
  pairs.EnableCollision(1, 1);
  [0, 1, 1].forEach((broad, layer) => layers.MapObjectToBroadPhaseLayer(layer, new J.BroadPhaseLayer(broad)));  // 2: bonded, meets nothing
  settings.mObjectLayerPairFilter = pairs;
  settings.mBroadPhaseLayerInterface = layers;
  settings.mObjectVsBroadPhaseLayerFilter = new J.ObjectVsBroadPhaseLayerFilterTable(layers, 2, pairs, 3);
  const jolt = new J.JoltInterface(settings), system = jolt.GetPhysicsSystem(), physics = system.GetPhysicsSettings();
  physics.mNumVelocitySteps = scene.setting("iterations", 10);
  physics.mNumPositionSteps = scene.setting("positions", 2);
  physics.mPenetrationSlop = scene.setting("slop", 0.02);
  physics.mSpeculativeContactDistance = scene.setting("speculative", 0.02);
  physics.mBaumgarte = scene.setting("baumgarte", 0.2);
  physics.mAllowSleeping = false;
  physics.mMinVelocityForRestitution = 1e9;
  system.SetPhysicsSettings(physics);
  return { jolt, system };
}

function makeShape(scene, block) {
  const radius = scene.setting("radius", 0.05);
  if (scene.setting("box", 1) && block.box) return new J.BoxShape(vector(block.box.map((length) => length / 2)), radius);
  const hull = new J.ConvexHullShapeSettings();
  for (const vertex of block.vertices) hull.mPoints.push_back(vector(vertex));
  hull.mMaxConvexRadius = radius;
  hull.mHullTolerance = 1e-4;
  const made = hull.Create();
  if (made.HasError()) throw new Error(made.GetError().c_str());
  return made.Get();
}

function addBlock(scene, block, bodies) {
  const [w, x, y, z] = block.turn;
  const creation = new J.BodyCreationSettings(makeShape(scene, block), new J.RVec3(...block.centre), new J.Quat(x, y, z, w),
    block.fixed ? J.EMotionType_Static : J.EMotionType_Dynamic, block.fixed ? 0 : 1);
  creation.mFriction = scene.friction;  // of two bodies: the root of the product
  creation.mRestitution = creation.mLinearDamping = creation.mAngularDamping = 0;
  creation.mAllowSleeping = false;
  creation.mApplyGyroscopicForce = true;
  if (!block.fixed) {
    creation.mOverrideMassProperties = J.EOverrideMassProperties_MassAndInertiaProvided;
    creation.mMassPropertiesOverride.mMass = block.mass;
    creation.mMassPropertiesOverride.mInertia = J.Mat44.prototype.sScaleVec3(vector(block.moments));
    creation.mLinearVelocity = vector(block.velocity);
    creation.mAngularVelocity = vector(block.spin);
  }
  const body = bodies.CreateBody(creation);
  bodies.AddBody(body.GetID(), block.fixed ? J.EActivation_DontActivate : J.EActivation_Activate);
  return body;
}

function addWeld(system, weld, bodyOf) {
  system.GetBodyInterface().SetObjectLayer(bodyOf(weld.block).GetID(), 2);
  return rodsOf(weld).map((rod) => {
    const rodSettings = new J.DistanceConstraintSettings(), spring = rodSettings.mLimitsSpringSettings;
    rodSettings.mSpace = J.EConstraintSpace_LocalToBodyCOM;
    rodSettings.mPoint1 = new J.RVec3(...rod.onFixed);
    rodSettings.mPoint2 = new J.RVec3(...rod.onBlock);
    rodSettings.mMinDistance = rodSettings.mMaxDistance = 1;
    spring.mMode = J.ESpringMode_StiffnessAndDamping;
    spring.mStiffness = rod.stiffness;
    spring.mDamping = rod.damping;
    const constraint = rodSettings.Create(bodyOf(weld.fixed), bodyOf(weld.block));
    system.AddConstraint(constraint);
    return constraint;
  });
}

function makeWorld(scene) {
  const { jolt, system } = makeSystem(scene), dt = scene.setting("dt", 0.002), gravity = vector([0, 0, 0]);
  const bodies = scene.blocks.map((block) => addBlock(scene, block, system.GetBodyInterface()));
  const bodyOf = (block) => bodies[scene.blocks.indexOf(block)];
  const bonds = scene.welds.map((weld) => addWeld(system, weld, bodyOf));
  const motionOf = (body) => {
    const q = body.GetRotation();
    return { centre: triple(body.GetCenterOfMassPosition()), turn: [q.GetW(), q.GetX(), q.GetY(), q.GetZ()],
      velocity: triple(body.GetLinearVelocity()), spin: triple(body.GetAngularVelocity()) };
  };
  const pushed = scene.blocks.flatMap((block, i) => {
    const force = scene.forces[block.name];
    return force ? [[bodies[i], force, vector([0, 0, 0]), vector([0, 0, 0])]] : [];
  });
  return {
    step(g, share) {
      gravity.Set(...g);
      system.SetGravity(gravity);
      for (const [body, full, force, moment] of pushed) {
        force.Set(...full.slice(0, 3).map((x) => share * x));
        moment.Set(...full.slice(3).map((x) => share * x));
        body.AddForce(force);
        body.AddTorque(moment);
      }
      jolt.Step(dt, 1);
      scene.welds.forEach((weld, k) => {
        if (bonds[k].length === 0 || !breaks(weld, motionOf(bodyOf(weld.block)))) return;
        bonds[k].splice(0).forEach((rod) => system.RemoveConstraint(rod));
        system.GetBodyInterface().SetObjectLayer(bodyOf(weld.block).GetID(), 1);
      });
    },
    motion: (i) => motionOf(bodies[i]),
    free() { J.destroy(jolt); },
  };
}

await runScenes(makeWorld);
