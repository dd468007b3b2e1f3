#include "experiments/run/child_process.h"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <linux/close_range.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/error.h"

namespace vitruvia {
namespace {

constexpr mode_t kMessagesMode = 0666;  // less the umask, as for any new file

// What posix_spawn does in the child before the program starts.
class SpawnActions {
 public:
  SpawnActions() { posix_spawn_file_actions_init(&actions_); }
  ~SpawnActions() {
    posix_spawn_file_actions_destroy(&actions_);
    if (messages_ >= 0) close(messages_);
  }
  SpawnActions(const SpawnActions&) = delete;
  SpawnActions& operator=(const SpawnActions&) = delete;

  // Messages go where ours go if the file cannot be opened.
  void SendMessagesTo(const std::filesystem::path& file) {
    messages_ = open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, kMessagesMode);
    if (messages_ >= 0) posix_spawn_file_actions_adddup2(&actions_, messages_, STDERR_FILENO);
  }
  // A descriptor copied to itself loses its mark to be closed on exec.
  void Inherit(int descriptor) {
    posix_spawn_file_actions_adddup2(&actions_, descriptor, descriptor);
  }

  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_;
  int messages_ = -1;
};

// What lists of processes show: of a link such as /proc/self/exe the file that it stands for.
std::string ShownName(const std::filesystem::path& program) {
  std::error_code is_no_link;
  const std::filesystem::path file = std::filesystem::read_symlink(program, is_no_link);
  return (is_no_link ? program : file).string();
}

std::string ProblemOf(int status) {
  if (!WIFSIGNALED(status)) return "";
  const int signal = WTERMSIG(status);
  return fmt::format("ended by signal {} ({})", signal, strsignal(signal));
}

}  // namespace

ChildProcesses::~ChildProcesses() {
  for (const Child& child : children_) kill(child.process, SIGTERM);
  for (const Child& child : children_) {
    while (waitpid(child.process, nullptr, 0) < 0 && errno == EINTR) continue;
  }
}

void ChildProcesses::Start(int id, const ChildCommand& command) {
  SpawnActions actions;
  if (!command.messages.empty()) actions.SendMessagesTo(command.messages);
  for (const int descriptor : command.inherited) actions.Inherit(descriptor);
  std::vector<std::string> words = command.arguments;
  words.insert(words.begin(), ShownName(command.program));
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  std::fflush(nullptr);  // what we have printed comes before what the child prints
  pid_t process = -1;
  const int error =
      posix_spawnp(&process, command.program.c_str(), actions.get(), nullptr, argv.data(), environ);
  if (error != 0)
    throw RunError(
        fmt::format("{}: cannot be started: {}", command.program.string(), std::strerror(error)));
  children_.push_back({process, id});
}

std::vector<ChildProcesses::End> ChildProcesses::TakeEnded() {
  std::vector<End> ended;
  std::erase_if(children_, [&ended](const Child& child) {
    int status = 0;
    if (waitpid(child.process, &status, WNOHANG) != child.process) return false;
    ended.push_back({child.id, WIFEXITED(status) ? WEXITSTATUS(status) : -1, ProblemOf(status)});
    return true;
  });
  return ended;
}

void EndWithParent(pid_t parent) {
  close_range(STDERR_FILENO + 1, ~0U, CLOSE_RANGE_CLOEXEC);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent)  // it ended before we asked to be told
    throw Error(ExitCode::kInterrupted, "the process that started this one has ended");
}

}  // namespace vitruvia
