// A terminal that gives each key at once and shows none, for as long as this lives. It is as it was
// afterwards, and also where Ctrl-C or another signal ends the program first. One at a time.
#pragma once

namespace twinarm {

class RawTerminal {
 public:
  explicit RawTerminal(int fd);  // must outlive this
  ~RawTerminal();
  RawTerminal(const RawTerminal&) = delete;
  bool is_terminal() const { return is_terminal_; }

 private:
  bool is_terminal_ = false;
};

}  // namespace twinarm
