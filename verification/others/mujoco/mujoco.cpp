// MuJoCo 2.2. Settings: dt; timeconst (s, of solref; never below two steps), dmin, dmax (of solimp): softness; cone
// (1 elliptic, 0 pyramid); box (1: native boxes); impratio; noslip, iterations; multiccd; cg (0: Newton); rk4 (0: Euler)
#include <mujoco/mujoco.h>

#include <cstring>
#include <memory>

#include "verification/others/scene.hpp"

namespace {

using namespace voussoir::others;

class MujocoWorld {
 public:
  explicit MujocoWorld(const EngineScene& scene) : scene_(scene) {
    load(text());
    for (const SceneBlock& block : scene.blocks) {
      const int body = mj_name2id(model_, mjOBJ_BODY, block.name.c_str());
      bodies_.push_back(body);
      if (block.fixed) continue;
      double* speed = data_->qvel + model_->jnt_dofadr[model_->body_jntadr[body]];
      const Triple own_spin = turned_back(block.turn, block.spin);
      std::ranges::copy(block.velocity, speed);
      std::ranges::copy(own_spin, speed + 3);
    }
    if (!scene.welds.empty()) soften_welds();
  }
  ~MujocoWorld() { mj_deleteData(data_), mj_deleteModel(model_); }
  MujocoWorld(MujocoWorld&&) = delete;

  void step(const Triple& gravity) {
    std::copy(gravity.begin(), gravity.end(), model_->opt.gravity);
    for (std::size_t i = 0; i < bodies_.size(); ++i)
      if (const auto force = scene_.force_on(i))
        std::copy(force->begin(), force->end(), data_->xfrc_applied + 6 * bodies_[i]);
    mj_step(model_, data_);
    // a full contact list drops contacts, and a speed beyond reason restarts the scene: neither is a result
    for (const mjtWarning kind : {mjWARN_CONTACTFULL, mjWARN_CNSTRFULL, mjWARN_BADQPOS, mjWARN_BADQVEL, mjWARN_BADQACC})
      if (data_->warning[kind].number > 0) throw std::runtime_error(mju_warningText(kind, 0));
    for (std::size_t w = 0; w < scene_.welds.size(); ++w)
      if (scene_.welds[w].breaks(motion(scene_.welds[w].block))) std::fill_n(model_->eq_active + 4 * w, 4, mjtByte{0});
  }

  BlockMotion motion(std::size_t i) const {
    const int joint = model_->body_jntadr[bodies_[i]];
    const double *q = data_->qpos + model_->jnt_qposadr[joint], *v = data_->qvel + model_->jnt_dofadr[joint];
    const Quaternion turn{q[3], q[4], q[5], q[6]};
    return {{q[0], q[1], q[2]}, {v[0], v[1], v[2]}, turned(turn, {v[3], v[4], v[5]}), turn};
  }

 private:
  // A point is kept by three rows, whose force is stiffness times error over the row's own regularisation.
  void soften_welds() {
    mj_forward(model_, data_);
    for (int e = 0; e < model_->neq; ++e) {
      const SceneWeld& weld = scene_.welds[e / 4];
      if (weld.normal_stiffness != weld.shear_stiffness) throw std::runtime_error("points have one stiffness");
      const double scale = -weld_impedance * data_->efc_R[3 * e], k = weld.normal_stiffness;
      model_->eq_solref[mjNREF * e] = scale * k;
      model_->eq_solref[mjNREF * e + 1] = scale * std::sqrt(k * scene_.blocks[weld.block].mass);
    }
  }

  // bonded faces as points that keep together, in place of contacts
  void weld_text(std::ostream& out) const {
    for (const SceneWeld& weld : scene_.welds) {
      const std::string pair =
          "body1='" + scene_.blocks[weld.block].name + "' body2='" + scene_.blocks[weld.fixed].name + "'";
      out << "<contact><exclude " << pair << "/></contact><equality>";
      for (const Triple& own : weld.own)
        out << "<connect " << pair << " anchor='" << own << "' solref='-1 -1' solimp='"
            << Triple{weld_impedance, weld_impedance, 0.001} << "'/>";
      out << "</equality>";
    }
  }

  void geometry(std::ostream& out, const SceneBlock& block) const {
    const double dt = scene_.setting("dt", 0.002);
    if (scene_.setting("box", 1) != 0 && block.is_box())
      out << "<geom type='box' size='" << Triple{block.box[0] / 2, block.box[1] / 2, block.box[2] / 2} << "'";
    else
      out << "<geom type='mesh' mesh='" << block.name << "'";
    out << " condim='3' margin='0' friction='" << Triple{scene_.friction, 0, 0} << "' solref='"
        << std::max(scene_.setting("timeconst", 0.02), 2 * dt) << " 1' solimp='" << scene_.setting("dmin", 0.9) << ' '
        << scene_.setting("dmax", 0.95) << " 0.001'/>";
  }

  std::string text() const {
    std::ostringstream out;
    out.precision(17);
    // contacts, which take three rows each; the engine counts bytes of a square matrix of rows in 31 bits
    const auto most = std::min<std::size_t>(200 + 40 * scene_.blocks.size(), 3800);
    out << "<mujoco><size nconmax='" << most << "' njmax='" << 3 * most + 12 * scene_.welds.size() << "'/>"
        << "<compiler inertiafromgeom='false' boundmass='0' boundinertia='0'/><option timestep='"
        << scene_.setting("dt", 0.002) << "' iterations='" << static_cast<int>(scene_.setting("iterations", 100))
        << "' tolerance='1e-10' cone='" << (scene_.setting("cone", 1) != 0 ? "elliptic" : "pyramidal") << "' impratio='"
        << scene_.setting("impratio", 1) << "' integrator='" << (scene_.setting("rk4", 0) != 0 ? "RK4" : "Euler")
        << "' solver='" << (scene_.setting("cg", 0) != 0 ? "CG" : "Newton") << "' noslip_iterations='"
        << static_cast<int>(scene_.setting("noslip", 0)) << "'><flag multiccd='"
        << (scene_.setting("multiccd", 1) != 0 ? "enable" : "disable") << "'/></option><asset>";
    for (const SceneBlock& block : scene_.blocks) {
      out << "<mesh name='" << block.name << "' vertex='";
      for (const Triple& vertex : block.vertices)
        out << vertex << ' ';
      out << "'/>";
    }
    out << "</asset><worldbody>";
    for (const SceneBlock& block : scene_.blocks) {
      const Quaternion& q = block.turn;
      out << "<body name='" << block.name << "' pos='" << block.centre << "' quat='" << q[0] << ' '
          << Triple{q[1], q[2], q[3]} << "'>";
      if (!block.fixed)
        out << "<freejoint/><inertial pos='0 0 0' mass='" << block.mass << "' diaginertia='" << block.moments << "'/>";
      geometry(out, block);
      out << "</body>";
    }
    out << "</worldbody>";
    weld_text(out);
    out << "</mujoco>";
    return out.str();
  }

  void load(const std::string& xml) {
    const auto owner = std::make_unique<mjVFS>();  // too large for the stack
    mjVFS* files = owner.get();
    mj_defaultVFS(files);
    mj_makeEmptyFileVFS(files, "scene.xml", static_cast<int>(xml.size() + 1));
    std::memcpy(files->filedata[0], xml.c_str(), xml.size() + 1);
    char error[1000] = "";
    model_ = mj_loadXML("scene.xml", files, error, 1000);
    mj_deleteVFS(files);
    if (!model_) throw std::runtime_error(error);
    data_ = mj_makeData(model_);
  }

  static constexpr double weld_impedance = 0.5;  // of the bond's rows: any value, as the stiffness takes it in
  const EngineScene& scene_;
  mjModel* model_ = nullptr;
  mjData* data_ = nullptr;
  std::vector<int> bodies_;
};

}  // namespace

int main() {
  mju_user_warning = [](const char*) {};  // step() reports them
  mju_user_error = [](const char* text) { throw std::runtime_error(text); };
  return run_scenes<MujocoWorld>();
}
