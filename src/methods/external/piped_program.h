// A child process. Its standard input and output are connected to a socket that this class writes
// and reads; it inherits standard error.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <sys/types.h>
#include <vector>

namespace vitruvia::external {

// Owns a file descriptor.
class Descriptor {
 public:
  explicit Descriptor(int fd = -1) : fd_(fd) {}
  ~Descriptor() { Close(); }
  Descriptor(Descriptor&& other) noexcept : fd_(other.Release()) {}
  Descriptor& operator=(Descriptor&& other) noexcept;

  int get() const { return fd_; }
  void Close();

 private:
  int Release();

  int fd_;
};

// Write, ReadLine and Read throw RunError naming the program if it has ended or does not answer in
// time, and Error(kInterrupted) if the user asked for a stop.
class PipedProgram {
 public:
  // Starts the program without a shell. ConfigError with the system's reason if it cannot be
  // executed; RunError if the system has no socket or process left.
  PipedProgram(const std::filesystem::path& program, const std::vector<std::string>& arguments,
               double answer_within_s);
  // Closes the program's input, waits a second for it to end, then kills it.
  ~PipedProgram();
  PipedProgram(const PipedProgram&) = delete;
  PipedProgram& operator=(const PipedProgram&) = delete;

  void Write(const void* data, std::size_t bytes);
  std::string ReadLine();  // without its newline
  void Read(void* data, std::size_t bytes);

  [[noreturn]] void Fail(const std::string& problem) const;  // RunError

 private:
  using Deadline = std::chrono::steady_clock::time_point;
  void StartProcess(const std::filesystem::path& program,
                    const std::vector<std::string>& arguments);
  Deadline NextDeadline() const;
  void Await(short events, Deadline deadline) const;
  void Receive(Deadline deadline);  // at least one more byte
  [[noreturn]] void FailBecauseGone(const std::string& when);
  bool WaitForEnd();  // false if the process still runs after a second

  std::string name_;
  std::chrono::duration<double> answer_within_;
  Descriptor socket_;
  pid_t process_ = -1;    // -1: none, or its end was already noticed
  int status_ = 0;        // of waitpid, once the process has ended
  std::string received_;  // bytes received but not yet returned
};

}  // namespace vitruvia::external
