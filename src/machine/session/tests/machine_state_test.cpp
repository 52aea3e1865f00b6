// Every cell of the table of states and events, and the page that is made from the table.
#include "passo/session/machine_state.hpp"

#include <set>
#include <utility>

#include "kit/golden.hpp"

namespace passo {
namespace {

constexpr std::array<MachineState, state_count> all_states = [] {
  std::array<MachineState, state_count> all{};
  for (std::size_t i = 0; i < state_count; ++i) all[i] = static_cast<MachineState>(i);
  return all;
}();
constexpr std::array<MachineEvent, event_count> all_events = [] {
  std::array<MachineEvent, event_count> all{};
  for (std::size_t i = 0; i < event_count; ++i) all[i] = static_cast<MachineEvent>(i);
  return all;
}();

// From `start`, by any events.
std::set<MachineState> reachable_from(MachineState start) {
  std::set<MachineState> found{start};
  for (std::size_t before = 0; before != found.size();) {
    before = found.size();
    for (const Transition& one : transitions) {
      if (found.contains(one.from)) found.insert(one.to);
    }
  }
  return found;
}

// A second row would never count, and a row that changes nothing hides a missing one.
TEST(MachineStates, no_cell_has_two_rows_and_every_row_changes_the_state) {
  std::set<std::pair<MachineState, MachineEvent>> cells;
  for (const Transition& one : transitions) {
    EXPECT_TRUE(cells.insert({one.from, one.event}).second) << name_of(one.from) << ", " << name_of(one.event);
    EXPECT_NE(one.from, one.to) << name_of(one.from) << ", " << name_of(one.event) << ": nothing changes";
  }
}

TEST(MachineStates, rows_stand_in_the_order_of_the_states_and_have_names_of_their_own) {
  std::set<std::string_view> names;
  for (const MachineState state : all_states) {
    EXPECT_EQ(row_of(state).state, state);
    EXPECT_TRUE(names.insert(name_of(state)).second) << name_of(state);
  }
  std::set<std::string_view> events;
  for (const MachineEvent event : all_events) EXPECT_TRUE(events.insert(name_of(event)).second) << name_of(event);
}

TEST(MachineStates, every_state_is_reached_from_offline_and_has_a_way_to_idle) {
  EXPECT_EQ(reachable_from(MachineState::offline).size(), state_count);
  for (const MachineState state : all_states) {
    EXPECT_TRUE(reachable_from(state).contains(MachineState::idle)) << name_of(state);
  }
}

TEST(MachineStates, every_event_happens_somewhere) {
  std::set<MachineEvent> seen;
  for (const Transition& one : transitions) seen.insert(one.event);
  EXPECT_EQ(seen.size(), event_count);
}

// What each event is about, cell by cell.
TEST(MachineStates, each_event_happens_just_where_it_has_a_meaning) {
  using enum MachineState;
  for (const MachineState state : all_states) {
    SCOPED_TRACE(name_of(state));
    const bool active = row_of(state).has_activity;
    const bool program = active && row_of(state).program_has_outputs;
    const auto happens = [&](MachineEvent event) { return next_state(state, event).has_value(); };
    EXPECT_EQ(happens(MachineEvent::ready), state == offline);
    for (const MachineEvent begin : {MachineEvent::begin_run, MachineEvent::begin_jog, MachineEvent::begin_home,
                                     MachineEvent::begin_probe, MachineEvent::begin_check, MachineEvent::fall_asleep}) {
      EXPECT_EQ(happens(begin), state == idle) << name_of(begin);
    }
    EXPECT_EQ(happens(MachineEvent::hold), program && state != hold) << "a state without a program accepts no hold";
    EXPECT_EQ(happens(MachineEvent::resume), program && state != run);
    EXPECT_EQ(happens(MachineEvent::want_tool), program && state != tool_change);
    EXPECT_EQ(happens(MachineEvent::want_line), program && state != await_line);
    EXPECT_EQ(happens(MachineEvent::open_door), (program && state != door) || state == idle);
    EXPECT_EQ(happens(MachineEvent::close_door), state == door);
    EXPECT_EQ(happens(MachineEvent::end), active);
    EXPECT_EQ(happens(MachineEvent::stop_at_once), state != alarm && state != fault);
    EXPECT_EQ(happens(MachineEvent::lose_board), state != fault);
    EXPECT_EQ(happens(MachineEvent::reset), state == idle || state == alarm || state == fault);
    EXPECT_EQ(happens(MachineEvent::wake), state == sleep);
  }
}

TEST(MachineStates, each_event_leads_to_the_state_that_it_names) {
  using enum MachineState;
  for (const Transition& one : transitions) {
    MachineState wanted = idle;  // end, close_door, ready, wake
    switch (one.event) {
      case MachineEvent::begin_run:
      case MachineEvent::resume: wanted = run; break;
      case MachineEvent::begin_jog: wanted = jog; break;
      case MachineEvent::begin_home: wanted = home; break;
      case MachineEvent::begin_probe: wanted = probe; break;
      case MachineEvent::begin_check: wanted = check; break;
      case MachineEvent::hold: wanted = hold; break;
      case MachineEvent::want_tool: wanted = tool_change; break;
      case MachineEvent::want_line: wanted = await_line; break;
      case MachineEvent::open_door: wanted = door; break;
      case MachineEvent::stop_at_once: wanted = alarm; break;
      case MachineEvent::lose_board: wanted = fault; break;
      case MachineEvent::reset: wanted = offline; break;
      case MachineEvent::fall_asleep: wanted = sleep; break;
      default: break;
    }
    EXPECT_EQ(one.to, wanted) << name_of(one.from) << ", " << name_of(one.event);
  }
}

TEST(MachineStates, only_a_program_has_outputs_and_only_what_goes_on_may_move) {
  for (const StateRow& row : state_rows) {
    if (row.state == MachineState::fault || row.state == MachineState::offline) continue;  // the board does what it did
    EXPECT_TRUE(row.has_activity || !row.may_move) << row.name;
    EXPECT_TRUE(row.has_activity || !row.program_has_outputs) << row.name;
  }
}

TEST(MachineStates, page_is_made_from_the_table) {
  test::expect_golden("docs/machine-states.md", state_page());
}

}  // namespace
}  // namespace passo
