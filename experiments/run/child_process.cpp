#include "experiments/run/child_process.h"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/error.h"

namespace vitruvia {
namespace {

constexpr mode_t kMessagesMode = 0666;  // less the umask, as for any new file

void SendMessagesTo(const std::filesystem::path& file) {
  if (file.empty()) return;
  const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND, kMessagesMode);
  if (descriptor < 0) return;  // then they go where ours go
  dup2(descriptor, STDERR_FILENO);
  close(descriptor);
}

[[noreturn]] void BeChild(pid_t parent, const std::filesystem::path& messages,
                          const std::function<int()>& work) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(static_cast<int>(ExitCode::kInterrupted));  // too late to be told
  SendMessagesTo(messages);
  const int code = work();
  std::fflush(nullptr);
  _exit(code);  // what the parent has open is the parent's to close
}

// A forked process has only the thread that forked: it would wait forever for work of the others.
void RequireNoThreads() {
  std::error_code unknown;
  const auto threads =
      std::distance(std::filesystem::directory_iterator("/proc/self/task", unknown),
                    std::filesystem::directory_iterator());
  Require(threads <= 1,
          "ChildProcesses: this process has {} threads (it has rendered something?); expected runs "
          "to be carried out before",
          threads);
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

void ChildProcesses::Start(int id, const std::filesystem::path& messages,
                           const std::function<int()>& work) {
  RequireNoThreads();
  std::fflush(nullptr);  // or both processes would write what is waiting
  const pid_t self = getpid();
  const pid_t process = fork();
  if (process < 0) throw RunError(fmt::format("no new process: {}", std::strerror(errno)));
  if (process == 0) BeChild(self, messages, work);
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

}  // namespace vitruvia
