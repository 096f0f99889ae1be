// Bullet 3.24, double precision. Settings: dt; iterations; directions (of friction: 1 or 2); margin (m); box (1: native
// boxes); sat (1: contact points by separating axes); solver (0 sequential impulses, 1 nonlinear conjugate gradients,
// 2 Dantzig); erp; split (1: overlap is mended without speed)
#include <BulletDynamics/ConstraintSolver/btNNCGConstraintSolver.h>
#include <BulletDynamics/MLCPSolvers/btDantzigSolver.h>
#include <BulletDynamics/MLCPSolvers/btMLCPSolver.h>
#include <btBulletDynamicsCommon.h>

#include <memory>

#include "verification/others/scene.hpp"

namespace {

using namespace voussoir::others;

btVector3 vector(const Triple& a) {
  return {a[0], a[1], a[2]};
}
Triple triple(const btVector3& a) {
  return {a.x(), a.y(), a.z()};
}

class BulletWorld {
 public:
  explicit BulletWorld(const EngineScene& scene) : scene_(scene), dt_(scene.setting("dt", 0.002)) {
    const int kind = static_cast<int>(scene.setting("solver", 0));
    if (kind == 0) solver_ = std::make_unique<btSequentialImpulseConstraintSolver>();
    if (kind == 1) solver_ = std::make_unique<btNNCGConstraintSolver>();
    if (kind == 2) solver_ = std::make_unique<btMLCPSolver>(&dantzig_);
    world_ = std::make_unique<btDiscreteDynamicsWorld>(&dispatcher_, &broad_phase_, solver_.get(), &configuration_);
    if (kind == 2) world_->getSolverInfo().m_minimumSolverBatchSize = 1;
    auto& info = world_->getSolverInfo();
    info.m_numIterations = static_cast<int>(scene.setting("iterations", 10));
    info.m_erp = info.m_erp2 = scene.setting("erp", 0.2);
    info.m_splitImpulse = scene.setting("split", 1) != 0;
    info.m_splitImpulsePenetrationThreshold = -1e-5;
    info.m_leastSquaresResidualThreshold = info.m_restitutionVelocityThreshold = 0;
    if (scene.setting("directions", 1) == 2) info.m_solverMode |= SOLVER_USE_2_FRICTION_DIRECTIONS;
    world_->getDispatchInfo().m_enableSatConvex = scene.setting("sat", 0) != 0;
    for (const SceneBlock& block : scene.blocks)
      add(block);
    for (const SceneWeld& weld : scene.welds)
      add(weld);
  }

  ~BulletWorld() {
    for (const auto& spring : springs_)
      world_->removeConstraint(spring.get());
    for (const auto& body : bodies_)
      world_->removeRigidBody(body.get());
  }
  BulletWorld(BulletWorld&&) = delete;

  void step(const Triple& gravity) {
    world_->setGravity(vector(gravity));
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const auto f = scene_.force_on(i);
      if (!f) continue;
      bodies_[i]->applyCentralForce(btVector3((*f)[0], (*f)[1], (*f)[2]));
      bodies_[i]->applyTorque(btVector3((*f)[3], (*f)[4], (*f)[5]));
    }
    world_->stepSimulation(dt_, 0);
    world_->clearForces();
    for (std::size_t w = 0; w < springs_.size(); ++w)
      if (springs_[w]->isEnabled() && scene_.welds[w].breaks(motion(scene_.welds[w].block)))
        springs_[w]->setEnabled(false);
  }

  BlockMotion motion(std::size_t i) const {
    const btTransform& pose = bodies_[i]->getWorldTransform();
    const btQuaternion q = pose.getRotation();
    return {triple(pose.getOrigin()), triple(bodies_[i]->getLinearVelocity()), triple(bodies_[i]->getAngularVelocity()),
            Quaternion{q.w(), q.x(), q.y(), q.z()}};
  }

 private:
  void add(const SceneBlock& block) {
    const double margin = scene_.setting("margin", 0);
    if (scene_.setting("box", 1) != 0 && block.is_box()) {
      shapes_.push_back(std::make_unique<btBoxShape>(vector(block.box) * 0.5));
    } else {
      auto hull = std::make_unique<btConvexHullShape>();
      for (const Triple& vertex : block.vertices)
        hull->addPoint(vector(vertex), false);
      hull->recalcLocalAabb();
      hull->setMargin(margin);
      hull->initializePolyhedralFeatures();
      shapes_.push_back(std::move(hull));
    }
    shapes_.back()->setMargin(margin);
    btRigidBody::btRigidBodyConstructionInfo info(block.fixed ? 0 : block.mass, nullptr, shapes_.back().get(),
                                                  block.fixed ? btVector3(0, 0, 0) : vector(block.moments));
    const Quaternion& q = block.turn;
    info.m_startWorldTransform = btTransform(btQuaternion(q[1], q[2], q[3], q[0]), vector(block.centre));
    info.m_friction = std::sqrt(scene_.friction);  // the engine multiplies the coefficients of both bodies
    info.m_restitution = info.m_linearDamping = info.m_angularDamping = 0;
    bodies_.push_back(std::make_unique<btRigidBody>(info));
    btRigidBody& body = *bodies_.back();
    body.setActivationState(DISABLE_DEACTIVATION);
    body.setLinearVelocity(vector(block.velocity));
    body.setAngularVelocity(vector(block.spin));
    body.setFlags(body.getFlags() | BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_BODY);
    world_->addRigidBody(&body);
  }

  // a bonded face: the engine's springs along three axes and about them, in place of contacts
  void add(const SceneWeld& weld) {
    const btVector3 middle = 0.5 * (vector(weld.points[0]) + vector(weld.points[3])), normal = vector(weld.normal),
                    side = (vector(weld.points[1]) - vector(weld.points[0])).normalized(),
                    axes[] = {normal, side, normal.cross(side)};
    const btTransform frame(btMatrix3x3(axes[0], axes[1], axes[2]).transpose(), middle);
    btRigidBody &fixed = *bodies_[weld.fixed], &block = *bodies_[weld.block];
    springs_.push_back(std::make_unique<btGeneric6DofSpring2Constraint>(
        fixed, block, fixed.getWorldTransform().inverse() * frame, block.getWorldTransform().inverse() * frame));
    for (int k = 0; k < 6; ++k) {
      double stiffness = 0;  // N/m, Nm/rad
      for (const Triple& point : weld.points) {
        const btVector3 way = k < 3 ? axes[k] : axes[k - 3].cross(vector(point) - middle);
        const double out = std::pow(way.dot(normal), 2);
        stiffness += weld.normal_stiffness * out + weld.shear_stiffness * (way.length2() - out);
      }
      springs_.back()->setLimit(k, 1, -1);  // none
      springs_.back()->enableSpring(k, true);
      springs_.back()->setStiffness(k, stiffness, false);
      springs_.back()->setDamping(k, std::sqrt(stiffness * scene_.blocks[weld.block].mass), false);
    }
    springs_.back()->setEquilibriumPoint();
    world_->addConstraint(springs_.back().get(), true);
  }

  const EngineScene& scene_;
  double dt_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broad_phase_;
  btDantzigSolver dantzig_;
  std::unique_ptr<btConstraintSolver> solver_;
  std::unique_ptr<btDiscreteDynamicsWorld> world_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
  std::vector<std::unique_ptr<btGeneric6DofSpring2Constraint>> springs_;
};

}  // namespace

int main() {
  return run_scenes<BulletWorld>();
}
