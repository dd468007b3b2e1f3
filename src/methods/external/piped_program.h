// A program started beside this one, whose standard input and output are ours to write and read.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <sys/types.h>
#include <vector>

namespace vitruvia::external {

// All members throw RunError naming the program if it has ended or takes too long, and
// Error(kInterrupted) if a stop was asked for. Its standard error goes where ours goes.
class PipedProgram {
 public:
  PipedProgram(const std::filesystem::path& program, const std::vector<std::string>& arguments,
               double answer_within_s);
  ~PipedProgram();  // closes its input, and ends it if it does not end by itself
  PipedProgram(const PipedProgram&) = delete;
  PipedProgram& operator=(const PipedProgram&) = delete;

  void Write(const void* data, std::size_t bytes);
  std::string ReadLine();  // without its newline
  void Read(void* data, std::size_t bytes);

  [[noreturn]] void Fail(const std::string& problem) const;

 private:
  using Deadline = std::chrono::steady_clock::time_point;
  Deadline NextDeadline() const;
  void Await(short events, Deadline deadline) const;
  void Receive(Deadline deadline);  // at least one byte more

  std::string name_;
  std::chrono::duration<double> answer_within_;
  pid_t process_ = -1;
  int socket_ = -1;
  std::string received_;  // and not yet read
};

}  // namespace vitruvia::external
