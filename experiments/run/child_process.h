// Child processes, so that a crash affects only one piece of work.
#pragma once

#include <filesystem>
#include <string>
#include <sys/types.h>
#include <vector>

namespace vitruvia {

struct ChildCommand {
  std::filesystem::path program;       // a name without "/" is looked up in PATH
  std::vector<std::string> arguments;  // without the program's name
  std::filesystem::path messages;      // standard error is appended to this file; "": it is ours
  std::vector<int> inherited;          // descriptors that stay open in the child, such as locks
};

// Children of this process, started by posix_spawn, which is safe with any threads running.
class ChildProcesses {
 public:
  ChildProcesses() = default;
  ~ChildProcesses();  // sends SIGTERM to children that still run, and waits for them
  ChildProcesses(const ChildProcesses&) = delete;
  ChildProcesses& operator=(const ChildProcesses&) = delete;

  // RunError naming the program and the system's reason if it cannot be started.
  void Start(int id, const ChildCommand& command);

  int running() const { return static_cast<int>(children_.size()); }

  struct End {
    int id;
    int code;             // exit code; −1 after a crash
    std::string problem;  // "" unless it crashed: "ended by signal 11 (Segmentation fault)"
  };
  // Children that have ended since the last call.
  std::vector<End> TakeEnded();

 private:
  struct Child {
    pid_t process;
    int id;
  };
  std::vector<Child> children_;
};

// For a child to call first: it is killed when the process `parent` that started it ends, however
// that ends, and the programs that it starts itself do not inherit its descriptors.
// Throws Error(kInterrupted) if the parent has ended already.
void EndWithParent(pid_t parent);

}  // namespace vitruvia
