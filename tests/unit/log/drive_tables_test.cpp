// SPDX-License-Identifier: MIT
#include "log/drive_tables.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "base/error.hpp"
#include "base/file.hpp"
#include "log/mcap_reader.hpp"
#include "log/run_log.hpp"
#include "log/run_log_channels.hpp"
#include "support/errors.hpp"
#include "support/random_doubles.hpp"
#include "support/temp_folder.hpp"

namespace hallway::log {
namespace {

namespace test = hallway::test;

constexpr std::int64_t kLastTime = std::numeric_limits<std::int64_t>::max();
constexpr std::array kAllCauses{CommandCause::kNone,     CommandCause::kPlugin, CommandCause::kPath,
                                CommandCause::kCommands, CommandCause::kHeld,   CommandCause::kWatchdog,
                                CommandCause::kTimeout,  CommandCause::kFailure};

std::vector<ObeyedCommand> some_commands() {
  const std::vector<double> values = test::random_doubles(900, 3);
  std::vector<ObeyedCommand> rows;
  for (std::uint32_t i = 0; i < 300; ++i) {
    rows.push_back({.iteration = 3 * i,
                    .linear_m_s = values[3 * i],
                    .angular_rad_s = values[3 * i + 1],
                    .lateral_m_s = values[3 * i + 2],
                    .acts_from_ns = i % 7 == 0 ? kLastTime : 1'000'000'007 * std::int64_t{i},
                    .cause = kAllCauses[i % kAllCauses.size()],
                    .changes = i % 2 == 0 ? "" : "speed+left_out"});
  }
  for (const std::string_view name : kCommandChanges) {
    rows.push_back({.iteration = rows.back().iteration + 1, .changes = std::string(name)});
  }
  return rows;
}

std::vector<ContactRow> some_contacts() {
  const std::vector<double> values = test::random_doubles(700, 4);
  const std::array<const char*, 5> kinds{"wall", "ledge", "step", "slope", "fall"};
  std::vector<ContactRow> rows;
  for (std::size_t i = 0; i < 100; ++i) {
    const double* v = &values[7 * i];
    rows.push_back({.t_ns = static_cast<std::int64_t>(i / 2) * 20'000'000,  // also two at once
                    .kind = kinds[i % kinds.size()],
                    .position_m = {v[0], v[1], v[2]},
                    .normal = {v[3], v[4], v[5]},
                    .speed_m_s = v[6]});
  }
  return rows;
}

std::vector<EventRow> some_events() {
  return {{0, "kidnap", "to hall; 3 m away"},
          {5, "sensor_off", "lidar"},
          {5, "wheels_blocked", ""},
          {kLastTime, "push", "\xc3\xbc \"quoted\""}};
}

TEST(DriveTables, ReadBackToTheSameBits) {
  const auto commands = some_commands();
  EXPECT_EQ(parse_obeyed_commands(print_table(kObeyedColumns, commands), "drive.csv"), commands);
  const auto contacts = some_contacts();
  EXPECT_EQ(parse_contacts(print_table(kContactColumns, contacts), "contacts.csv"), contacts);
  const auto events = some_events();
  EXPECT_EQ(parse_events(print_table(kEventColumns, events), "events.csv"), events);
}

TEST(DriveTables, ArePrintedInTheDocumentedForm) {
  EXPECT_EQ(print_table(kObeyedColumns, std::vector<ObeyedCommand>{{.iteration = 2,
                                                                    .linear_m_s = 0.25,
                                                                    .angular_rad_s = -0.5,
                                                                    .acts_from_ns = 40,
                                                                    .cause = CommandCause::kHeld,
                                                                    .changes = "speed+angular"}}),
            "iteration,linear_m_s,angular_rad_s,lateral_m_s,acts_from_ns,cause,changes\n"
            "2,0.25,-0.5,0,40,held,speed+angular\n");
  EXPECT_EQ(print_table(kContactColumns, std::vector<ContactRow>{{7, "wall", {1, 2, 0}, {0, -1, 0}, 0.5}}),
            "t_ns,kind,x_m,y_m,z_m,nx,ny,nz,speed_m_s\n7,wall,1,2,0,0,-1,0,0.5\n");
  EXPECT_EQ(print_table(kEventColumns, std::vector<EventRow>{{7, "sensor_on", "lidar"}}),
            "t_ns,kind,what\n7,sensor_on,lidar\n");
}

TEST(DriveTables, AreReadFromFiles) {
  const test::TempFolder folder;
  write_file_atomically(folder / "d.csv", print_table(kObeyedColumns, some_commands()));
  write_file_atomically(folder / "c.csv", print_table(kContactColumns, some_contacts()));
  write_file_atomically(folder / "e.csv", print_table(kEventColumns, some_events()));
  EXPECT_EQ(read_obeyed_commands(folder / "d.csv"), some_commands());
  EXPECT_EQ(read_contacts(folder / "c.csv"), some_contacts());
  EXPECT_EQ(read_events(folder / "e.csv"), some_events());
  const auto error = test::error_of([&] { read_contacts(folder / "none.csv"); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kIo);
}

/// A row that is refused and the column that its error names; empty for none.
struct BadRow {
  const char* row;
  const char* column;
};

template <typename Parse>
void expect_rows_refused(std::string_view columns, const std::string& good, const std::vector<BadRow>& rows,
                         Parse parse) {
  const std::string head = std::string(columns) + "\n" + good + "\n";
  EXPECT_EQ(parse(head).size(), 1u);
  for (const BadRow& bad : rows) {
    const auto error = test::error_of([&] { parse(head + bad.row); });
    ASSERT_TRUE(error) << bad.row;
    EXPECT_EQ(error->code(), ErrorCode::kBadInput) << bad.row;
    EXPECT_EQ(error->where().file, "t.csv") << bad.row;
    EXPECT_EQ(error->where().line, 3) << bad.row;
    EXPECT_NE(error->where().element.find(bad.column), std::string::npos) << bad.row << ": " << error->what();
  }
  EXPECT_TRUE(test::error_of([&] { parse(""); }));
  for (const std::string& header : {std::string("a,b\n"), std::string(columns.substr(2)) + "\n"}) {
    const auto error = test::error_of([&] { parse(header); });
    ASSERT_TRUE(error) << header;
    EXPECT_EQ(error->where().line, 1) << header;
  }
}

TEST(DriveTables, BadRowsOfCommandsAreNamed) {
  expect_rows_refused(kObeyedColumns, "4,0.5,0,0,20,plugin,",
                      {{"4,0.5,0,0,20,plugin,\n", "iteration"},
                       {"-1,0.5,0,0,20,plugin,\n", "iteration"},
                       {"100000000,0.5,0,0,20,plugin,\n", "iteration"},
                       {"5,nan,0,0,20,plugin,\n", "linear_m_s"},
                       {"5,0,1e999,0,20,plugin,\n", "angular_rad_s"},
                       {"5,0,0,,20,plugin,\n", "lateral_m_s"},
                       {"5,0,0,0,-20,plugin,\n", "acts_from_ns"},
                       {"5,0,0,0,9223372036854775808,plugin,\n", "acts_from_ns"},
                       {"5,0,0,0,2.5,plugin,\n", "acts_from_ns"},
                       {"5,0,0,0,20,Plugin,\n", "cause"},
                       {"5,0,0,0,20,,\n", "cause"},
                       {"5,0,0,0,20,held,fast\n", "changes"},
                       {"5,0,0,0,20,held,speed+\n", "changes"},
                       {"5,0,0,0,20,held\n", ""},
                       {"5,0,0,0,20,held,", ""}},
                      [](const std::string& text) { return parse_obeyed_commands(text, "t.csv"); });
}

TEST(DriveTables, BadRowsOfContactsAreNamed) {
  expect_rows_refused(kContactColumns, "20,wall,1,2,3,0,0,1,0.5",
                      {{"19,wall,1,2,3,0,0,1,0.5\n", "t_ns"},
                       {"-1,wall,1,2,3,0,0,1,0.5\n", "t_ns"},
                       {"21,,1,2,3,0,0,1,0.5\n", "kind"},
                       {"21,Wall,1,2,3,0,0,1,0.5\n", "kind"},
                       {"21,wall,1,inf,3,0,0,1,0.5\n", "y_m"},
                       {"21,wall,1,2,3,0,x,1,0.5\n", "ny"},
                       {"21,wall,1,2,3,0,0,1,\n", "speed_m_s"},
                       {"21,wall,1,2,3,0,0,1,0.5,7\n", ""}},
                      [](const std::string& text) { return parse_contacts(text, "t.csv"); });
}

TEST(DriveTables, BadRowsOfEventsAreNamed) {
  expect_rows_refused(
      kEventColumns, "20,push,0.1 m/s",
      {{"19,push,\n", "t_ns"}, {"20,pu sh,\n", "kind"}, {"20,push\n", ""}, {"20,push,a,b\n", ""}},
      [](const std::string& text) { return parse_events(text, "t.csv"); });
}

TEST(DriveTables, WhatCouldNotBeReadBackIsNotWritten) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [](auto&& row) {
    RowWriter out(',');
    const auto in_table = test::error_of([&] { add_row(out, row); });
    StringOutput bytes;
    RunLogWriter log(bytes, "test", "{}");
    const auto in_log = test::error_of([&] {
      using Row = std::decay_t<decltype(row)>;
      if constexpr (std::is_same_v<Row, ObeyedCommand>) log.add_obeyed({}, row);
      if constexpr (std::is_same_v<Row, ContactRow>) log.add_contact({}, row);
      if constexpr (std::is_same_v<Row, EventRow>) log.add_event({}, row);
    });
    return in_table && in_table->code() == ErrorCode::kInternal && in_log &&
           in_log->code() == ErrorCode::kInternal;
  };
  EXPECT_TRUE(refused(ObeyedCommand{.linear_m_s = nan}));
  EXPECT_TRUE(refused(ObeyedCommand{.acts_from_ns = -1}));
  EXPECT_TRUE(refused(ObeyedCommand{.changes = "speed,angular"}));
  EXPECT_TRUE(refused(ContactRow{.t_ns = -1, .kind = "wall"}));
  EXPECT_TRUE(refused(ContactRow{.kind = ""}));
  EXPECT_TRUE(refused(ContactRow{.kind = "wall", .normal = {nan, 0, 0}}));
  for (const char* what : {"a,b", "a\nb", " a", "a\t"}) {
    EXPECT_TRUE(refused(EventRow{.kind = "push", .what = what})) << what;
  }
}

/// The messages of drives in a log, in its order.
std::vector<DriveMessage> drive_messages(const std::string& bytes) {
  const MemoryInput input(bytes);
  McapReader reader(input);
  std::vector<DriveMessage> messages;
  while (const McapItem* item = reader.next()) {
    if (const auto* message = std::get_if<McapMessage>(item))
      messages.push_back(parse_drive_message(reader.channels().at(message->channel_id), *message));
  }
  EXPECT_FALSE(reader.damage());
  return messages;
}

TEST(DriveLog, ReadsBackToTheSameBits) {
  StringOutput out;
  RunLogWriter log(out, "test", "{}");
  for (const ObeyedCommand& command : some_commands()) log.add_obeyed({command.iteration, 1}, command);
  for (const ContactRow& contact : some_contacts()) log.add_contact({8, 2}, contact);
  for (const EventRow& event : some_events()) log.add_event({9, 3}, event);
  log.finish();
  std::vector<ObeyedCommand> commands;
  std::vector<ContactRow> contacts;
  std::vector<EventRow> events;
  for (const DriveMessage& message : drive_messages(out.text())) {
    if (const auto* command = std::get_if<ObeyedCommand>(&message)) commands.push_back(*command);
    if (const auto* contact = std::get_if<ContactMessage>(&message)) {
      contacts.push_back(contact->contact);
      EXPECT_EQ(contact->iteration, 8u);
    }
    if (const auto* event = std::get_if<EventMessage>(&message)) {
      events.push_back(event->event);
      EXPECT_EQ(event->iteration, 9u);
    }
  }
  EXPECT_EQ(commands, some_commands());
  EXPECT_EQ(contacts, some_contacts());
  EXPECT_EQ(events, some_events());
}

TEST(DriveLog, ChannelsOfOlderLogsKeepTheirNumbers) {
  EXPECT_EQ(run_channel_id(topics::kActivation), 1);
  EXPECT_EQ(run_channel_id(topics::kTruePlanes), 11);
  EXPECT_EQ(run_channel_id(topics::kObeyed), 12);
  EXPECT_EQ(run_channel_id(topics::kContact), 13);
  EXPECT_EQ(run_channel_id(topics::kEvent), 14);
}

DriveMessage parse_text(std::string_view topic, std::string_view data) {
  return parse_drive_message(
      {.id = 1, .schema_id = 0, .topic = std::string(topic), .encoding = "json", .metadata = {}},
      {.channel_id = 1, .data = data});
}

TEST(DriveLog, MessagesThatAreNoneAreRefusedWithTheirTopic) {
  const std::string obeyed =
      R"({"iteration":1,"linear_m_s":0.5,"angular_rad_s":0,"lateral_m_s":0,"acts_from_ns":7,"cause":"held","changes":""})";
  const std::string contact =
      R"({"iteration":1,"t_ns":7,"kind":"wall","x_m":1,"y_m":2,"z_m":3,"nx":0,"ny":0,"nz":1,"speed_m_s":0.5})";
  const std::string event = R"({"iteration":1,"t_ns":7,"kind":"push","what":"left"})";
  EXPECT_NO_THROW(parse_text(topics::kObeyed, obeyed));
  EXPECT_NO_THROW(parse_text(topics::kContact, contact));
  EXPECT_NO_THROW(parse_text(topics::kEvent, event));
  EXPECT_TRUE(std::holds_alternative<std::monostate>(parse_text(topics::kPose, "{")));

  struct Edit {
    std::string_view topic;
    std::string text;
    const char* from;
    const char* to;
  };
  const std::vector<Edit> edits{{topics::kObeyed, obeyed, "{", "["},
                                {topics::kObeyed, obeyed, R"("iteration":1)", R"("iteration":-1)"},
                                {topics::kObeyed, obeyed, R"("iteration":1,)", ""},
                                {topics::kObeyed, obeyed, "0.5", R"("fast")"},
                                {topics::kObeyed, obeyed, "0.5", "1e999"},
                                {topics::kObeyed, obeyed, ":7", ":-7"},
                                {topics::kObeyed, obeyed, "held", "kept"},
                                {topics::kObeyed, obeyed, R"("changes":"")", R"("changes":"more")"},
                                {topics::kContact, contact, ":7", ":9223372036854775808"},
                                {topics::kContact, contact, "wall", "a wall"},
                                {topics::kContact, contact, R"("nx":0)", R"("nx":null)"},
                                {topics::kContact, contact, R"(,"speed_m_s":0.5)", ""},
                                {topics::kEvent, event, "push", ""},
                                {topics::kEvent, event, "left", "left,right"},
                                {topics::kEvent, event, R"("left")", "3"}};
  for (const Edit& edit : edits) {
    std::string text = edit.text;
    text.replace(text.find(edit.from), std::string_view(edit.from).size(), edit.to);
    const auto error = test::error_of([&] { parse_text(edit.topic, text); });
    ASSERT_TRUE(error) << text;
    EXPECT_EQ(error->code(), ErrorCode::kBadInput) << text;
    EXPECT_NE(error->message().find(edit.topic), std::string::npos) << error->message();
  }
}

}  // namespace
}  // namespace hallway::log
