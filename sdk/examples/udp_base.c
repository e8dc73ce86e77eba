// SPDX-License-Identifier: MIT
// A robot's base that speaks Hallway's datagram protocol (docs/formats.md, "Robots over UDP"): it says what it is, sends one frame of points
// and takes one command. What a microcontroller needs stands above the line; below are the sockets of a PC, for which it has its own.
//
//     udp_base 7000        listens to 127.0.0.1:7000, prints the command that it was given
//
// Little-endian machines only, as nearly all of them are: numbers are copied as they stand.

#include <stdint.h>
#include <string.h>

enum { kHeaderBytes = 32, kMaxDatagramBytes = 1400 };
enum { kHello = 1, kDescription = 2, kFrame = 3, kAnswer = 5, kBye = 6 };
enum { kReplyWanted = 1, kReady = 2 };

/// CRC-32 as of zlib and Ethernet; begins with 0.
static uint32_t crc32_of(uint32_t crc, const uint8_t* bytes, size_t size) {
  size_t i;
  int bit;
  crc = ~crc;
  for (i = 0; i < size; ++i) {
    crc ^= bytes[i];
    for (bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1u) ? 0xedb88320u : 0u);
  }
  return ~crc;
}

static void put16(uint8_t* at, uint16_t value) {
  memcpy(at, &value, sizeof value);
}
static void put32(uint8_t* at, uint32_t value) {
  memcpy(at, &value, sizeof value);
}
static void put64(uint8_t* at, uint64_t value) {
  memcpy(at, &value, sizeof value);
}
static void put_double(uint8_t* at, double value) {
  memcpy(at, &value, sizeof value);
}

/// Writes the head before the `size` bytes that stand behind it already; returns the length of the datagram.
static size_t finish_datagram(uint8_t* datagram, uint8_t type, uint32_t session, uint64_t sequence,
                              size_t size) {
  memset(datagram, 0, kHeaderBytes);
  memcpy(datagram, "HWUD", 4);
  datagram[4] = 1;
  datagram[5] = type;
  put32(datagram + 8, session);
  put64(datagram + 16, sequence);
  put16(datagram + 26, 1);  // one fragment
  put16(datagram + 28, (uint16_t)size);
  put32(datagram + 12, crc32_of(0, datagram, kHeaderBytes + size));
  return kHeaderBytes + size;
}

/// The type of a datagram that came, 0 if it is none of this protocol.
static uint8_t type_of(uint8_t* datagram, size_t size) {
  uint32_t told = 0;
  uint16_t payload = 0;
  if (size < kHeaderBytes || memcmp(datagram, "HWUD\x01", 5) != 0) return 0;
  memcpy(&told, datagram + 12, sizeof told);
  memcpy(&payload, datagram + 28, sizeof payload);
  put32(datagram + 12, 0);
  if (payload != size - kHeaderBytes || told != crc32_of(0, datagram, size)) return 0;
  return datagram[5];
}

/// One sensor of points, "eyes", mounted 0.5 m above the body; what else could be said of it is not known.
static size_t describe(uint8_t* datagram, uint32_t session, uint64_t nonce) {
  uint8_t* at = datagram + kHeaderBytes;
  int i;
  memset(at, 0, kMaxDatagramBytes - kHeaderBytes);
  put32(at, 0);             // flags: real time
  put32(at + 4, 1);         // sensors
  put64(at + 8, 50000000);  // 20 frames a second
  put64(at + 16, 4);        // the robot's name, filled up to a multiple of 8
  memcpy(at + 24, "base", 4);
  at += 32;
  put32(at, 0);      // id of the sensor
  put32(at + 4, 1);  // it gives points
  put_double(at + 24, 0.5);
  put_double(at + 32, 1.0);                                             // not turned: w, x, y, z = 1, 0, 0, 0
  for (i = 0; i < 7; ++i) put64(at + 64 + 8 * i, 0x7ff8000000000000u);  // not known: NaN
  put64(at + 120, 4);
  memcpy(at + 128, "eyes", 4);
  return finish_datagram(datagram, kDescription, session, nonce, 32 + 136);
}

/// A frame of `count` points (x, y, z in metres, the sensor's frame): one reading of sensor 0. At most 50 points fit in one datagram.
static size_t frame(uint8_t* datagram, uint32_t session, uint64_t sequence, int64_t t_ns,
                    const double* points, uint32_t count) {
  uint8_t* at = datagram + kHeaderBytes;
  const size_t size = 144 + 24 * (size_t)count;
  memset(at, 0, size);
  memcpy(at, "HWFB", 4);
  put32(at + 4, 1);
  put64(at + 8, size);
  put32(at + 16, 1);   // ABI 1.0
  put32(at + 24, 32);  // hw_frame_t
  put32(at + 28, 1);   // samples
  put64(at + 32, sequence);
  put64(at + 40, (uint64_t)t_ns);
  put64(at + 48, 56);  // where the table of samples stands
  put64(at + 56, 64);  // and there, where the sample stands
  put32(at + 64, 48);  // hw_sample_t
  put32(at + 68, 1);   // points
  put64(at + 80, sequence);
  put64(at + 88, (uint64_t)t_ns);
  put64(at + 96, (uint64_t)t_ns);
  put64(at + 104, 112);  // where its points stand
  put32(at + 112, 32);   // hw_points_t
  put32(at + 116, 24);   // bytes from one to the next
  put64(at + 120, count);
  put64(at + 128, 144);  // where they stand
  memcpy(at + 144, points, 24 * (size_t)count);
  return finish_datagram(datagram, kFrame, session, sequence, size);
}

/// The command of an answer: forward, m/s, and to the left, rad/s. 0 if it has none.
static int command_of(const uint8_t* datagram, double* linear, double* angular) {
  uint32_t flags = 0;
  memcpy(&flags, datagram + kHeaderBytes + 4, sizeof flags);
  memcpy(linear, datagram + kHeaderBytes + 24, sizeof *linear);
  memcpy(angular, datagram + kHeaderBytes + 32, sizeof *angular);
  return (flags & 1u) != 0;
}

// ---------------------------------------------------------------------------------------------------------------------

#include <arpa/inet.h>
#include <netinet/in.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <sys/time.h>

/// A socket that listens to a port of this machine and waits no longer than half a second.
static int listen_to(uint16_t port) {
  const struct timeval half = {0, 500000};
  struct sockaddr_in own;
  const int fd = socket(AF_INET, SOCK_DGRAM, 0);
  memset(&own, 0, sizeof own);
  own.sin_family = AF_INET;
  own.sin_port = htons(port);
  own.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (fd < 0 || bind(fd, (const struct sockaddr*)&own, sizeof own) != 0) return -1;
  setsockopt(fd, SOL_SOCKET, SO_RCVTIMEO, &half, sizeof half);
  return fd;
}

/// Serves the first host that says hello: until its first command, or a minute. 0 if there was one.
static int serve(int fd) {
  const uint32_t session = 1;
  const double points[] = {1.0, 0.0, 0.5, 2.0, -1.0, 0.5};
  uint8_t datagram[kMaxDatagramBytes];
  struct sockaddr_in host;
  uint64_t nonce = 0, sequence = 0;
  int waits = 0;
  while (waits < 120) {
    socklen_t length = sizeof host;
    double linear = 0, angular = 0;
    uint16_t flags = 0;
    size_t size = 0;
    const ssize_t got = recvfrom(fd, datagram, sizeof datagram, 0, (struct sockaddr*)&host, &length);
    const uint8_t type = got > 0 ? type_of(datagram, (size_t)got) : 0;
    waits += got < 0;
    if (type == kHello) {
      memcpy(&nonce, datagram + 16, sizeof nonce);
      memcpy(&flags, datagram + 6, sizeof flags);
      size = describe(datagram, session, nonce);
      sendto(fd, datagram, size, 0, (const struct sockaddr*)&host, length);
      if ((flags & kReady) == 0) continue;
      // A real base does this at its own pace from now on.
      size = frame(datagram, session, sequence, (int64_t)sequence * 50000000, points, 2);
      sendto(fd, datagram, size, 0, (const struct sockaddr*)&host, length);
      ++sequence;
    } else if (type == kAnswer && command_of(datagram, &linear, &angular)) {
      printf("%g m/s, %g rad/s\n", linear, angular);
      size = finish_datagram(datagram, kBye, session, 0, 0);
      sendto(fd, datagram, size, 0, (const struct sockaddr*)&host, length);
      return 0;
    }
  }
  return 1;
}

int main(int argc, char** argv) {
  const int fd = argc == 2 ? listen_to((uint16_t)atoi(argv[1])) : -1;
  if (fd < 0) {
    fprintf(stderr, "usage: udp_base PORT, one that is free\n");
    return 2;
  }
  return serve(fd);
}
