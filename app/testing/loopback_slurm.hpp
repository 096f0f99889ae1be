// A Slurm cluster of two nodes with one processor each, on the loopback: its daemons are children of the test, all
// their files are in one folder, and it needs no root.
#pragma once

#include <arpa/inet.h>
#include <fmt/format.h>
#include <sys/socket.h>

#include <array>
#include <cstdio>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <sstream>

#include "app/testing/process.hpp"

namespace voussoir {

// standard output and error of a shell command, without the last line break
inline std::string said(const std::string& line) {
  std::string text;
  FILE* const pipe = ::popen(("{ " + line + "; } 2>&1 </dev/null").c_str(), "r");
  for (std::array<char, 4096> part; const std::size_t count = std::fread(part.data(), 1, part.size(), pipe);)
    text.append(part.data(), count);
  ::pclose(pipe);
  while (text.ends_with('\n'))
    text.pop_back();
  return text;
}

class LoopbackSlurm {
 public:
  // the part that is not installed; empty: it can be started
  static std::string missing() {
    for (const char* tool : {"munged", "slurmctld", "slurmd", "sbatch"})
      if (path_of(tool).empty()) return fmt::format("{} is not installed (packages slurm-wlm, munge)", tool);
    return "";
  }

  explicit LoopbackSlurm(const std::filesystem::path& folder) : folder_(folder) {
    for (const char* name : {"munge", "state", "spool"})
      std::filesystem::create_directories(folder_ / name);
    write_configuration();
    ::setenv("SLURM_CONF", (folder_ / "slurm.conf").c_str(), 1);
    const std::string munge = (folder_ / "munge/").string();
    start("munged", {"--foreground", "--force", "--key-file=" + munge + "key", "--socket=" + munge + "socket",
                     "--pid-file=" + munge + "pid", "--log-file=" + munge + "log", "--seed-file=" + munge + "seed"});
    wait_until([&] { return std::filesystem::exists(munge + "socket"); });
    start("slurmctld", {"-D", "-c"});
    for (const char* node : {"node1", "node2"})
      start("slurmd", {"-D", "-N", node}, node);
  }

  // no job outlives the cluster
  ~LoopbackSlurm() {
    for (const int process : processes_of(""))
      ::kill(process, SIGKILL);
    ::unsetenv("SLURM_CONF");
  }

  // false: it did not come up in half a minute
  bool is_up() const { return comes_to_be("sinfo -hN -o %T | grep -cx idle", "2", 30); }

  // the job's number, or the message of sbatch
  std::string submit(const std::string& arguments) const {
    return said("sbatch --parsable --output='" + (folder_ / "job-%A_%a").string() + "' " + arguments);
  }
  bool wait_until_idle() const { return comes_to_be("squeue -h", "", 240); }
  std::string output(const std::string& job) const { return read(folder_ / ("job-" + job)); }

  // as in a power failure: no process there can write anything more
  void kill_node(const std::string& node) {
    daemons_.at(node)->send(SIGKILL);
    const std::set<int> processes = processes_of(node);
    for (const int signal : {SIGSTOP, SIGKILL})
      for (const int process : processes)
        ::kill(process, signal);
  }

  // the node that a process works on, from its environment
  static std::string node_of(int process) { return variable(process, "SLURMD_NODENAME"); }

  // the daemons' logs, for a test that fails
  std::string log() const {
    return said(fmt::format("tail -n 20 '{0}'/*.err; squeue -a; scontrol show nodes", folder_.string()));
  }

 private:
  // polled: `sbatch --wait` would sleep for up to half a minute
  static bool comes_to_be(const std::string& line, const std::string& answer, int seconds) {
    for (int k = 0; k < 5 * seconds; ++k) {
      if (said(line) == answer) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
    }
    return false;
  }

  static std::string path_of(const std::string& tool) {
    return said("PATH=\"$PATH:/usr/sbin:/sbin\" command -v " + tool + " || true");
  }

  static std::string variable(int process, const std::string& name) {
    const std::string environment = '\0' + read(fmt::format("/proc/{}/environ", process));
    const std::size_t found = environment.find('\0' + name + "=");
    return found == std::string::npos ? "" : environment.c_str() + found + name.size() + 2;
  }

  bool is_ours(int process) const { return variable(process, "SLURM_CONF") == (folder_ / "slurm.conf").string(); }

  // of a node: the processes of its jobs and their supervisors; without a node: all of ours
  std::set<int> processes_of(const std::string& node) const {
    std::set<int> found;
    for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
      const int process = std::atoi(entry.path().filename().c_str());
      if (process <= 0 || process == ::getpid() || !is_ours(process)) continue;
      if (node.empty()) found.insert(process);
      if (node.empty() || node_of(process) != node) continue;
      found.insert(process);
      std::istringstream status(read(entry.path() / "stat"));
      std::string skipped;
      int parent = 0;
      status >> skipped >> skipped >> skipped >> parent;  // of our own program, whose name has no space
      if (parent > 1 && is_ours(parent)) found.insert(parent);
    }
    return found;
  }

  static int free_port() {
    const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    ::bind(socket, reinterpret_cast<sockaddr*>(&address), size);
    ::getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size);
    ::close(socket);
    return ntohs(address.sin_port);
  }

  // A job that was requeued waits until its credential has expired, after 120 s by default, 5 s at least. With the two
  // timeouts a dead node is detected after about 10 s instead of 300.
  void write_configuration() const {
    const std::string user = said("id -un"), folder = folder_.string();
    std::ofstream(folder_ / "slurm.conf") << fmt::format(R"(ClusterName=loopback
SlurmctldHost=localhost(127.0.0.1)
SlurmctldPort={0}
SlurmUser={3}
SlurmdUser={3}
AuthType=auth/munge
AuthInfo=socket={4}/munge/socket,cred_expire=5
CredType=cred/munge
StateSaveLocation={4}/state
SlurmdSpoolDir={4}/spool/%n
SlurmctldPidFile={4}/slurmctld.pid
SlurmdPidFile={4}/%n.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=batch_sched_delay=0,sched_interval=1,sched_min_interval=0,bf_interval=1
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
JobCompType=jobcomp/none
JobRequeue=1
KillWait=10
SlurmdTimeout=5
MessageTimeout=2
CompleteWait=0
SlurmdParameters=config_overrides
NodeName=node1 NodeHostname=localhost NodeAddr=127.0.0.1 Port={1} CPUs=1 RealMemory=500 State=UNKNOWN
NodeName=node2 NodeHostname=localhost NodeAddr=127.0.0.1 Port={2} CPUs=1 RealMemory=500 State=UNKNOWN
PartitionName=study Nodes=ALL Default=YES MaxTime=INFINITE State=UP
)",
                                                         free_port(), free_port(), free_port(), user, folder);
    // the older plugin needs no file system and no systemd as long as nothing is confined
    std::ofstream(folder_ / "cgroup.conf") << "CgroupPlugin=cgroup/v1\n";
    std::ofstream key(folder_ / "munge/key", std::ios::binary);
    std::random_device random;
    for (int k = 0; k < 128; ++k)
      key.put(static_cast<char>(random()));
    key.close();
    std::filesystem::permissions(folder_ / "munge/key", std::filesystem::perms(0600));
  }

  void start(const std::string& tool, const std::vector<std::string>& arguments, std::string name = {}) {
    if (name.empty()) name = tool;
    daemons_[name] = std::make_unique<Process>(path_of(tool), Launch{.arguments = arguments}, folder_ / name);
  }

  std::filesystem::path folder_;
  std::map<std::string, std::unique_ptr<Process>> daemons_;
};

}  // namespace voussoir
