// SPDX-License-Identifier: MIT
// A mesh loader that behaves as the name of the file says.
#include <signal.h>

#include <chrono>
#include <string>
#include <thread>

#include "base/helper.hpp"
#include "mesh/protocol.hpp"
#include "unit/mesh/models.hpp"

namespace {

using hallway::write_standard_output;

std::string good_reply() {
  std::string reply;
  hallway::mesh::encode_model(hallway::test::cube(), [&](std::string_view bytes) { reply.append(bytes); });
  return reply;
}

void behave(const std::string& how) {
  const std::string reply = good_reply();
  if (how == "good") write_standard_output(reply);
  if (how == "garbage") write_standard_output(std::string(10'000, '\xAA'));
  if (how == "cut") write_standard_output(reply.substr(0, reply.size() / 2));
  if (how == "twice") write_standard_output(reply + reply);
  if (how == "hang") std::this_thread::sleep_for(std::chrono::hours(1));
  if (how == "crash after half") {
    write_standard_output(reply.substr(0, reply.size() / 2));
    ::signal(SIGSEGV, SIG_DFL);
    ::raise(SIGSEGV);
  }
  if (how == "crash after all") {
    write_standard_output(reply);
    ::signal(SIGSEGV, SIG_DFL);
    ::raise(SIGSEGV);
  }
  if (how == "flood") {
    for (;;) write_standard_output(reply);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 || !hallway::begin_helper(argv[1])) return 2;
  const std::string file = hallway::mesh::decode_request(hallway::read_standard_input(100'000)).file;
  const std::string how = file.substr(file.rfind('/') + 1);
  if (how == "status") return 9;
  behave(how);
  return 0;
}
