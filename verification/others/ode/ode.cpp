// ODE 0.16, double precision. Settings: dt; shape (0 convex, 1 native boxes if all blocks are boxes, 2 triangle
// meshes); quick (1: iterations of the quick step; 0: Dantzig's direct solver); iterations; cfm and erp (softness of
// contacts); contacts (the most of a pair); slip (0: the engine's own friction directions, 1: along the slip and across
// it, 2: along the slip only)
#include <ode/ode.h>

#include <list>

#include "verification/others/scene.hpp"

namespace {

using namespace voussoir::others;

// what a convex shape of ODE points at as long as it lives
struct ConvexArrays {
  std::vector<dReal> planes, points;
  std::vector<unsigned> polygons;
  std::vector<dTriIndex> triangles;

  explicit ConvexArrays(const SceneBlock& block) {
    for (const Triple& p : block.vertices)
      points.insert(points.end(), p.begin(), p.end());
    for (const auto& [plane, corners] : block.faces) {
      planes.insert(planes.end(), plane.begin(), plane.end());
      polygons.push_back(static_cast<unsigned>(corners.size()));
      polygons.insert(polygons.end(), corners.begin(), corners.end());
      for (std::size_t k = 2; k < corners.size(); ++k)
        triangles.insert(triangles.end(), {corners[0], corners[k - 1], corners[k]});
    }
  }
};

class OdeWorld {
 public:
  explicit OdeWorld(const EngineScene& scene) : scene_(scene) {
    dWorldSetQuickStepNumIterations(world_, number("iterations", 20));
    dWorldSetCFM(world_, cfm_);
    const bool boxes = std::ranges::all_of(scene.blocks, &SceneBlock::is_box);
    if (shape_ == 1 && !boxes) shape_ = 0;  // the engine finds no contact between a box and a convex shape
    for (const SceneBlock& block : scene.blocks)
      add(block);
  }
  ~OdeWorld() {
    dJointGroupDestroy(contacts_);
    dSpaceDestroy(space_);
    dWorldDestroy(world_);
  }
  OdeWorld(OdeWorld&&) = delete;

  void step(const Triple& gravity) {
    dWorldSetGravity(world_, gravity[0], gravity[1], gravity[2]);
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const auto f = scene_.force_on(i);
      if (f)
        dBodyAddForce(bodies_[i], (*f)[0], (*f)[1], (*f)[2]), dBodyAddTorque(bodies_[i], (*f)[3], (*f)[4], (*f)[5]);
    }
    dSpaceCollide(space_, this, [](void* world, dGeomID a, dGeomID b) { static_cast<OdeWorld*>(world)->meet(a, b); });
    if (!(quick_ ? dWorldQuickStep(world_, dt_) : dWorldStep(world_, dt_))) throw std::runtime_error("out of memory");
    dJointGroupEmpty(contacts_);
  }

  BlockMotion motion(std::size_t i) const {
    const dReal *x = dBodyGetPosition(bodies_[i]), *q = dBodyGetQuaternion(bodies_[i]);
    const dReal *v = dBodyGetLinearVel(bodies_[i]), *w = dBodyGetAngularVel(bodies_[i]);
    return {{x[0], x[1], x[2]}, {v[0], v[1], v[2]}, {w[0], w[1], w[2]}, {q[0], q[1], q[2], q[3]}};
  }

 private:
  void meet(dGeomID a, dGeomID b) {
    const dBodyID x = dGeomGetBody(a), y = dGeomGetBody(b);
    if (!x && !y) return;
    std::vector<dContact> found(most_);
    const int count = dCollide(a, b, most_, &found[0].geom, sizeof(dContact));
    for (int i = 0; i < count; ++i) {
      dContact& contact = found[i];
      // convex blocks that just touch: normals of length zero, which stop the program
      if (!(contact.geom.depth >= 0) || dCalcVectorLength3(contact.geom.normal) < 0.5) continue;
      contact.surface.mode = dContactApprox1 | dContactSoftERP | dContactSoftCFM;
      contact.surface.mu = scene_.friction;
      contact.surface.soft_erp = erp_;
      contact.surface.soft_cfm = cfm_;
      if (slip_ != 0) turn_to_slip(contact, x, y);
      dJointAttach(dJointCreateContact(world_, contacts_, &contact), x, y);
    }
  }

  // the first friction direction along the relative velocity at the contact, if there is one
  void turn_to_slip(dContact& contact, dBodyID x, dBodyID y) const {
    dVector3 u = {0, 0, 0}, v = {0, 0, 0};
    const dReal *p = contact.geom.pos, *n = contact.geom.normal;
    if (x) dBodyGetPointVel(x, p[0], p[1], p[2], u);
    if (y) dBodyGetPointVel(y, p[0], p[1], p[2], v);
    dSubtractVectors3(u, u, v);
    dAddScaledVectors3(u, u, n, 1, -dCalcVectorDot3(u, n));
    if (!(dCalcVectorLength3(u) > 1e-8)) return;
    dNormalize3(u);
    dCopyVector3(contact.fdir1, u);
    contact.surface.mode |= dContactFDir1 | (slip_ == 2 ? dContactMu2 : 0);
    contact.surface.mu2 = 0;
  }

  dGeomID shape_of(const SceneBlock& block) {
    if (shape_ == 1) return dCreateBox(space_, block.box[0], block.box[1], block.box[2]);
    ConvexArrays& a = arrays_.emplace_back(block);
    const int points = static_cast<int>(block.vertices.size()), faces = static_cast<int>(block.faces.size());
    if (shape_ == 0) return dCreateConvex(space_, &a.planes[0], faces, &a.points[0], points, a.polygons.data());
    const dTriMeshDataID data = dGeomTriMeshDataCreate();
    dGeomTriMeshDataBuildDouble(data, a.points.data(), 3 * sizeof(double), points, a.triangles.data(),
                                static_cast<int>(a.triangles.size()), 3 * sizeof(dTriIndex));
    return dCreateTriMesh(space_, data, nullptr, nullptr, nullptr);
  }

  void add(const SceneBlock& block) {
    const dGeomID shape = shape_of(block);
    const dQuaternion q = {block.turn[0], block.turn[1], block.turn[2], block.turn[3]};
    bodies_.push_back(block.fixed ? nullptr : dBodyCreate(world_));
    const dBodyID body = bodies_.back();
    if (body) dGeomSetBody(shape, body);
    dGeomSetPosition(shape, block.centre[0], block.centre[1], block.centre[2]);  // and the body's
    dGeomSetQuaternion(shape, q);
    if (!body) return;
    dMass mass;
    const Triple& i = block.moments;
    dMassSetParameters(&mass, block.mass, 0, 0, 0, i[0], i[1], i[2], 0, 0, 0);
    dBodySetMass(body, &mass);
    dBodySetLinearVel(body, block.velocity[0], block.velocity[1], block.velocity[2]);
    dBodySetAngularVel(body, block.spin[0], block.spin[1], block.spin[2]);
    dBodySetGyroscopicMode(body, 1);
  }

  int number(const char* key, int otherwise) const { return static_cast<int>(scene_.setting(key, otherwise)); }

  const EngineScene& scene_;
  double dt_ = scene_.setting("dt", 0.002), erp_ = scene_.setting("erp", 0.2), cfm_ = scene_.setting("cfm", 1e-9);
  int most_ = number("contacts", 8), slip_ = number("slip", 0), shape_ = number("shape", 1);
  bool quick_ = number("quick", 1) != 0;
  dWorldID world_ = dWorldCreate();
  dSpaceID space_ = dSimpleSpaceCreate(nullptr);
  dJointGroupID contacts_ = dJointGroupCreate(0);
  std::list<ConvexArrays> arrays_;
  std::vector<dBodyID> bodies_;
};

}  // namespace

int main() {
  dInitODE();
  return run_scenes<OdeWorld>();
}
