// Box2D 2.4 in the x-z plane, for prisms along y. Settings: dt; iterations (of velocities); positions (iterations);
// radius (m, by which a polygon's edges are shifted outwards)
#include <box2d/box2d.h>

#include <memory>

#include "verification/others/scene.hpp"

namespace {

using namespace voussoir::others;

struct SameFriction : b2ContactListener {
  float coefficient = 0;
  void PreSolve(b2Contact* contact, const b2Manifold*) override {
    contact->SetFriction(coefficient);
    contact->SetRestitution(0);
  }
};

class PlaneWorld {
 public:
  explicit PlaneWorld(const EngineScene& scene)
      : scene_(scene),
        dt_(static_cast<float>(scene.setting("dt", 0.002))),
        iterations_(static_cast<int>(scene.setting("iterations", 8))),
        positions_(static_cast<int>(scene.setting("positions", 3))) {
    world_.SetAllowSleeping(false);
    world_.SetContinuousPhysics(false);
    friction_.coefficient = static_cast<float>(scene.friction);
    world_.SetContactListener(&friction_);
    for (const SceneBlock& block : scene.blocks)
      add(block);
    for (const SceneWeld& weld : scene.welds)
      add_weld(weld);
  }

  void step(const Triple& gravity) {
    world_.SetGravity(in_plane(gravity));
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const auto f = scene_.force_on(i);
      if (!f) continue;
      bodies_[i]->ApplyForceToCenter(in_plane({(*f)[0], (*f)[1], (*f)[2]}), true);
      bodies_[i]->ApplyTorque(static_cast<float>(-(*f)[4]), true);
    }
    world_.Step(dt_, iterations_, positions_);
    for (std::size_t w = 0; w < rods_.size(); ++w)
      if (!rods_[w].empty() && scene_.welds[w].breaks(motion(scene_.welds[w].block))) {
        std::ranges::for_each(rods_[w], [this](b2Joint* rod) { world_.DestroyJoint(rod); });
        rods_[w].clear();
      }
  }

  BlockMotion motion(std::size_t i) const {
    const b2Body& body = *bodies_[i];
    const b2Vec2 x = body.GetWorldCenter(), v = body.GetLinearVelocity();
    const double half = -0.5 * body.GetAngle(), c = std::cos(half), s = std::sin(half);  // the plane x-z turns about -y
    const Quaternion& q = scene_.blocks[i].turn;
    return {{x.x, scene_.blocks[i].centre[1], x.y},
            {v.x, 0, v.y},
            {0, -body.GetAngularVelocity(), 0},
            {c * q[0] - s * q[2], c * q[1] + s * q[3], c * q[2] + s * q[0], c * q[3] - s * q[1]}};
  }

 private:
  // A bonded face as elastic rods of 1 m: one along the normal at each spring, one along the face at its middle.
  void add_weld(const SceneWeld& weld) {
    const b2Vec2 normal = in_plane(weld.normal), along(-normal.y, normal.x);
    b2Vec2 middle(0, 0);
    auto& rods = rods_.emplace_back();
    const auto rod = [&](const b2Vec2& at, const b2Vec2& direction, double stiffness, double damping) {
      b2DistanceJointDef definition;
      definition.Initialize(bodies_[weld.fixed], bodies_[weld.block], at - direction, at);
      definition.minLength = 0;
      definition.maxLength = 2;
      definition.stiffness = static_cast<float>(stiffness);
      definition.damping = static_cast<float>(damping);
      rods.push_back(world_.CreateJoint(&definition));
    };
    const double mass = scene_.blocks[weld.block].mass;
    for (const Triple& point : weld.points) {
      rod(in_plane(point), normal, weld.normal_stiffness, std::sqrt(weld.normal_stiffness * mass));
      middle += 0.25f * in_plane(point);
    }
    rod(middle, along, 4 * weld.shear_stiffness, 4 * std::sqrt(weld.shear_stiffness * mass));
  }

  static b2Vec2 in_plane(const Triple& a) { return {static_cast<float>(a[0]), static_cast<float>(a[2])}; }

  // The section's corners in the world's axes at the start, from the centre: the principal axes of a prism are any
  // permutation of section and length, so the block's own turn is put into the corners.
  static std::vector<b2Vec2> section(const SceneBlock& block) {
    std::vector<b2Vec2> corners;
    for (const Triple& vertex : block.vertices)
      if (const Triple corner = turned(block.turn, vertex); corner[1] > 0) corners.push_back(in_plane(corner));
    return corners;
  }

  // the moment about the section's normal: that of the axis which the turn brings to y
  static double moment_about_y(const SceneBlock& block) {
    const Triple row = turned_back(block.turn, {0, 1, 0});
    double moment = 0;
    for (int k = 0; k < 3; ++k)
      moment += row[k] * row[k] * block.moments[k];
    return moment;
  }

  void add(const SceneBlock& block) {
    b2BodyDef definition;
    definition.type = block.fixed ? b2_staticBody : b2_dynamicBody;
    definition.position = in_plane(block.centre);
    definition.linearVelocity = in_plane(block.velocity);
    definition.angularVelocity = static_cast<float>(-block.spin[1]);
    b2Body* body = world_.CreateBody(&definition);
    const std::vector<b2Vec2> corners = section(block);
    if (corners.size() > b2_maxPolygonVertices) throw std::runtime_error("a section has more than 8 corners");
    b2PolygonShape shape;
    shape.Set(corners.data(), static_cast<int>(corners.size()));
    shape.m_radius = static_cast<float>(scene_.setting("radius", b2_polygonRadius));
    body->CreateFixture(&shape, 1);
    if (!block.fixed) {
      b2MassData mass;
      mass.mass = static_cast<float>(block.mass);
      mass.center.SetZero();
      mass.I = static_cast<float>(moment_about_y(block));
      body->SetMassData(&mass);
    }
    bodies_.push_back(body);
  }

  const EngineScene& scene_;
  float dt_;
  int iterations_, positions_;
  SameFriction friction_;
  b2World world_{b2Vec2(0, 0)};
  std::vector<b2Body*> bodies_;
  std::vector<std::vector<b2Joint*>> rods_;  // of a weld; none once it is broken
};

}  // namespace

int main() {
  return run_scenes<PlaneWorld>();
}
