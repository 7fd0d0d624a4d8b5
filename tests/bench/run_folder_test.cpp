#include "bench/run_folder.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>

#include "bench/judgement.hpp"
#include "bench/run_recordings.hpp"
#include "bench/sha256.hpp"
#include "bench/text_file.hpp"
#include "bench/verdict_json.hpp"
#include "tests/bench/judgements.hpp"
#include "tests/support/scratch_folder.hpp"

namespace rvbench::bench {

using rvbench::test::ScratchFolder;

TEST_CASE("a serial never leaves its folder", "[bench]") {
  for (const char* serial :
       {"../../etc", "/etc/passwd", "..", ".", "a/b", "a\\b", ".hidden", "-rf", "x\n", "RV 20E"}) {
    INFO(serial);
    const std::filesystem::path name = folder_name_of(serial);
    CHECK(std::distance(name.begin(), name.end()) == 1);
    CHECK(name != "..");
    CHECK(name.string().find_first_of("/\\ \n") == std::string::npos);
    CHECK(name.string().find_first_of(".-") != 0);
  }
  CHECK(folder_name_of("A17-b_2.0") == "A17-b_2.0");
  CHECK(folder_name_of(std::string(5000, 'x')).size() < 100);
  CHECK_THROWS_AS(folder_name_of(""), std::invalid_argument);
}

TEST_CASE("different serials do not share a folder", "[bench]") {
  CHECK(folder_name_of("A/1") != folder_name_of("A_1"));
  CHECK(folder_name_of("A/1") != folder_name_of("A:1"));
  CHECK(folder_name_of(std::string(70, 'x') + "1") != folder_name_of(std::string(70, 'x') + "2"));
}

TEST_CASE("two runs in one second get two folders", "[bench]") {
  const ScratchFolder scratch;
  const auto first = create_run_folder(scratch.path(), "A17", "20260102T030405Z");
  const auto second = create_run_folder(scratch.path(), "A17", "20260102T030405Z");
  CHECK(first == scratch.path() / "A17" / "20260102T030405Z");
  CHECK(first != second);
  CHECK(std::filesystem::is_directory(second));
}

TEST_CASE("a run goes on at the point that was interrupted", "[bench]") {
  const rvbench::test::ScratchFolder scratch;
  hal::RecordingLayout layout;
  layout.points.resize(3);
  layout.torque_rate_Hz = 100;
  const auto record = [&](const char* name, const std::vector<hal::PointResult>& results) {
    const auto writer = hal::RecordingWriter::create(scratch.path() / name, layout);
    REQUIRE(writer);
    for (const hal::PointResult& result : results) REQUIRE(writer.value()->end_point(result));
    REQUIRE(writer.value()->close());
  };
  const auto next_point = [&] {
    const auto run = RunRecordings::open(scratch.path());
    REQUIRE(run);
    return run.value().next_point();
  };
  CHECK(next_point() == 0);
  record("recording.h5", {{.point = 0}, {.point = 1, .status = "interrupted"}});
  CHECK(next_point() == 1);
  record("recording-2.h5", {{.point = 1}});
  CHECK(next_point() == 2);
  CHECK(recording_names(scratch.path()) ==
        std::vector<std::string>{"recording.h5", "recording-2.h5"});
}

TEST_CASE("only a run without a verdict on the unit can be resumed", "[bench]") {
  const ScratchFolder scratch;
  CHECK_FALSE(newest_unfinished_run(scratch.path(), "A17"));
  const auto older = create_run_folder(scratch.path(), "A17", "20260102T030405Z");
  const auto newer = create_run_folder(scratch.path(), "A17", "20260102T030406Z");
  write_file(older / "plan.json", "{}");
  write_file(newer / "plan.json", "{}");
  CHECK(newest_unfinished_run(scratch.path(), "A17") == newer);

  Judgement judgement = test::failed_run();
  judgement.ending = {Outcome::aborted, ErrorKind::none, "stopped by the operator"};
  write_file(newer / "verdict.json", judgement_to_json(judgement));
  write_sums(newer);
  CHECK(newest_unfinished_run(scratch.path(), "A17") == newer);
  write_file(newer / "verdict.json", judgement_to_json(test::failed_run()));
  write_sums(newer);
  CHECK_FALSE(newest_unfinished_run(scratch.path(), "A17"));
}

TEST_CASE("the newest run is the one that began last, whatever the clock said", "[bench]") {
  const ScratchFolder scratch;
  const auto begin = [&](const std::string& utc) {
    const RunBegin begun = next_run(scratch.path(), "A17", utc);
    const auto run = create_run_folder(scratch.path(), "A17", utc);
    write_file(run / "start.json", run_begin_to_json(begun));
    write_file(run / "plan.json", "{}");
    return run;
  };
  SECTION("it was set back") {
    begin("20260102T030405Z");
    const auto newest = begin("20260102T020000Z");
    CHECK(newest_unfinished_run(scratch.path(), "A17") == newest);
    CHECK(read_run_begin(newest).number == 2);
    CHECK(read_run_begin(newest).serial == "A17");
  }
  SECTION("ten others began in the same second") {
    for (int i = 0; i < 10; ++i) begin("20260102T030405Z");
    const auto newest = begin("20260102T030405Z");
    CHECK(newest.filename() == "20260102T030405Z-11");
    CHECK(newest_unfinished_run(scratch.path(), "A17") == newest);
  }
  SECTION("they did so before runs were numbered") {
    for (const char* name : {"20260102T030405Z", "20260102T030405Z-2", "20260102T030405Z-10"}) {
      std::filesystem::create_directories(scratch.path() / "A17" / name);
      write_file(scratch.path() / "A17" / name / "plan.json", "{}");
    }
    CHECK(newest_unfinished_run(scratch.path(), "A17")->filename() == "20260102T030405Z-10");
    const auto numbered = begin("20250101T000000Z");
    CHECK(newest_unfinished_run(scratch.path(), "A17") == numbered);
  }
}

TEST_CASE("no serial takes the place of what lies beside the runs", "[bench]") {
  for (const char* serial : {"results.db", "results.db-wal", "results.db-shm"}) {
    CHECK(folder_name_of(serial).starts_with("_esults.db"));
  }
  CHECK(folder_name_of("results.db") != folder_name_of("_esults.db"));
  CHECK(folder_name_of("limits").starts_with("_imits-"));
  CHECK(folder_name_of("qualification").starts_with("_ualification-"));
  CHECK(folder_name_of("limits_of_A17") == "limits_of_A17");
}

TEST_CASE("a run that was killed while its results were written can be resumed", "[bench]") {
  const ScratchFolder scratch;
  const auto run = create_run_folder(scratch.path(), "A17", "20260102T030405Z");
  write_file(run / "plan.json", "{}");
  write_file(run / "verdict.json", judgement_to_json(test::passed_run()));
  CHECK(newest_unfinished_run(scratch.path(), "A17") == run);  // no report, no sums
  write_sums(run);
  CHECK_FALSE(newest_unfinished_run(scratch.path(), "A17"));
}

TEST_CASE("SHA-256 is the one of FIPS 180-4", "[bench][literature]") {
  CHECK(sha256_of_text("abc") ==
        "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  CHECK(sha256_of_text("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST_CASE("SHA256SUMS tells a sound folder from a tampered one", "[bench]") {
  const ScratchFolder folder;
  write_file(folder.path() / "verdict.json", "{}");
  write_file(folder.path() / "name with space.txt", "x");
  CHECK(verify_sums(folder.path()).size() == 1);
  write_sums(folder.path());
  CHECK(verify_sums(folder.path()).empty());

  SECTION("sha256sum agrees") {
    const std::string command =
        "cd '" + folder.path().string() + "' && sha256sum --strict --quiet -c SHA256SUMS";
    CHECK(std::system(command.c_str()) == 0);
  }
  SECTION("a changed file is named") {
    write_file(folder.path() / "verdict.json", "{ }");
    CHECK(verify_sums(folder.path()) ==
          std::vector<std::string>{"verdict.json: does not match its hash"});
  }
  SECTION("a removed file is named") {
    std::filesystem::remove(folder.path() / "verdict.json");
    CHECK(verify_sums(folder.path()) == std::vector<std::string>{"verdict.json: missing"});
  }
  SECTION("an added file is named") {
    write_file(folder.path() / "extra", "");
    CHECK(verify_sums(folder.path()) ==
          std::vector<std::string>{"extra: not listed in SHA256SUMS"});
  }
  SECTION("what is no file is named, and is not waited for") {
    REQUIRE(mkfifo((folder.path() / "pipe").c_str(), 0600) == 0);
    std::filesystem::create_symlink("loop", folder.path() / "loop");
    const std::vector<std::string> foreign{"loop: not a file of the run",
                                           "pipe: not a file of the run"};
    CHECK(verify_sums(folder.path()) == foreign);
    std::filesystem::remove(folder.path() / "verdict.json");
    REQUIRE(mkfifo((folder.path() / "verdict.json").c_str(), 0600) == 0);
    CHECK(verify_sums(folder.path()).front() ==
          "verdict.json: is no regular file, or cannot be read");
    std::filesystem::remove(folder.path() / "SHA256SUMS");
    REQUIRE(mkfifo((folder.path() / "SHA256SUMS").c_str(), 0600) == 0);
    CHECK(verify_sums(folder.path()).front() ==
          "SHA256SUMS: is no regular file, or cannot be read");
  }
  SECTION("a draft that a kill left of any file is none of the files") {
    std::ofstream(folder.path() / "verdict.json.draft") << "half";
    std::ofstream(folder.path() / "verdict.json.4711-1.part") << "half";
    CHECK(verify_sums(folder.path()).empty());
    std::ofstream(folder.path() / "stranger.draft") << "half";
    std::ofstream(folder.path() / "stranger.4711-1.part") << "half";
    std::ofstream(folder.path() / "verdict.json.part") << "half";
    CHECK(verify_sums(folder.path()) ==
          std::vector<std::string>{"stranger.4711-1.part: not listed in SHA256SUMS",
                                   "stranger.draft: not listed in SHA256SUMS",
                                   "verdict.json.part: not listed in SHA256SUMS"});
  }
  SECTION("a list that a kill left half written is none of the files") {
    for (const std::string draft : {"SHA256SUMS.draft", "SHA256SUMS.4711-1.part"}) {
      std::ofstream(folder.path() / draft) << "half";
      write_sums(folder.path());
      CHECK(verify_sums(folder.path()).empty());
    }
  }
  SECTION("the list cannot point out of the folder") {
    write_file(folder.path() / "SHA256SUMS", std::string(64, 'a') + "  ../../etc/passwd\n");
    CHECK(verify_sums(folder.path()).front() == "SHA256SUMS:1: not a line of sha256sum");
  }
}

}  // namespace rvbench::bench
