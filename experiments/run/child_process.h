// Work that goes on in processes of its own beside this one, so that a crash costs one piece of it.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <sys/types.h>
#include <vector>

namespace vitruvia {

// Children forked from this process. They end when it does, however it does.
class ChildProcesses {
 public:
  ChildProcesses() = default;
  ~ChildProcesses();  // asks those still there to stop, and waits for them
  ChildProcesses(const ChildProcesses&) = delete;
  ChildProcesses& operator=(const ChildProcesses&) = delete;

  // Calls `work` in a child, which then ends with the code that it returns; `work` throws nothing.
  // This process must not have other threads; rendering leaves some behind.
  // Its messages (standard error) go to the end of the file, or where ours go if that is "".
  void Start(int id, const std::filesystem::path& messages, const std::function<int()>& work);

  int running() const { return static_cast<int>(children_.size()); }

  struct End {
    int id;
    int code;             // as returned by `work`; −1 after a crash
    std::string problem;  // "" unless it crashed: "ended by signal 11 (Segmentation fault)"
  };
  // Those that have ended since the last call.
  std::vector<End> TakeEnded();

 private:
  struct Child {
    pid_t process;
    int id;
  };
  std::vector<Child> children_;
};

}  // namespace vitruvia
