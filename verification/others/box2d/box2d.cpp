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
  static b2Vec2 in_plane(const Triple& a) { return {static_cast<float>(a[0]), static_cast<float>(a[2])}; }

  // The section's corners in the world's axes at the start, from the centre: the principal axes of a prism are any
  // permutation of section and length, so the block's own turn is put into the corners.
  static std::vector<b2Vec2> section(const SceneBlock& block) {
    std::vector<b2Vec2> corners;
    const Quaternion& q = block.turn;
    for (const Triple& p : block.vertices) {
      const double x = (1 - 2 * (q[2] * q[2] + q[3] * q[3])) * p[0] + 2 * (q[1] * q[2] - q[0] * q[3]) * p[1] +
                       2 * (q[1] * q[3] + q[0] * q[2]) * p[2];
      const double y = 2 * (q[1] * q[2] + q[0] * q[3]) * p[0] + (1 - 2 * (q[1] * q[1] + q[3] * q[3])) * p[1] +
                       2 * (q[2] * q[3] - q[0] * q[1]) * p[2];
      const double z = 2 * (q[1] * q[3] - q[0] * q[2]) * p[0] + 2 * (q[2] * q[3] + q[0] * q[1]) * p[1] +
                       (1 - 2 * (q[1] * q[1] + q[2] * q[2])) * p[2];
      if (y > 0) corners.push_back(in_plane({x, y, z}));
    }
    return corners;
  }

  // the moment about the section's normal: that of the axis which the turn brings to y
  static double moment_about_y(const SceneBlock& block) {
    const Quaternion& q = block.turn;
    const Triple row{2 * (q[1] * q[2] + q[0] * q[3]), 1 - 2 * (q[1] * q[1] + q[3] * q[3]),
                     2 * (q[2] * q[3] - q[0] * q[1])};
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
};

}  // namespace

int main() {
  return run_scenes<PlaneWorld>();
}
