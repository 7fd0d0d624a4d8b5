#include <cstdlib>

#include "tests/hal/export_fixture.hpp"

// What others make of exported files, none of whose code is ours.
namespace rvbench::hal {
namespace {

using test::exported;
using test::ScratchFolder;
using test::written_as;

bool runs(const std::string& command) { return std::system(command.c_str()) == 0; }

bool is_there(const std::string& what, const std::string& command) {
  if (runs(command + " >/dev/null 2>&1")) return true;
  WARN("skipped: no " << what << " (bench/install_packages --tests)");
  return false;
}

}  // namespace

TEST_CASE("h5py and scipy open what was exported", "[hal][formats][export]") {
  if (!is_there("h5py and scipy", "/usr/bin/python3 -c 'import h5py, scipy'")) return;
  const ScratchFolder scratch;
  for (const char* key : {"hdf5", "mat5", "mat73", "wav"}) {
    written_as(key, scratch / key, {exported()});
  }
  std::ofstream(scratch / "look.py") << R"(
import h5py, numpy, scipy.io, scipy.io.wavfile
ramp = numpy.arange(-4, 6) * 0.25

f = h5py.File('hdf5', 'r')
p = f['points/000']
assert (p.attrs['speed_rpm'], p.attrs['measured_speed_rpm'], p.attrs['repeat']) == (605, 604.5, 2)
assert p.attrs['start_time'] == b'2016-10-14T10:51:17.000000Z', p.attrs['start_time']
g = p['acceleration']
assert g.attrs['rate_Hz'] == 5000 and g.attrs['t0_s'] == 2.5 and g.attrs['sensitivity'][0] == 0.0125
assert g.attrs['units'][0].decode() == 'm/s²' and g.attrs['directions'][0] == b'-Y'
assert g['data'].dtype == 'float32' and (g['data'][:, 0] == ramp).all()
assert p['torque'].attrs['channels'][0] == b'input_torque'

m = scipy.io.loadmat('mat5', squeeze_me=True, struct_as_record=False)
a = m['accel_1x']
assert (a.data == ramp).all() and a.data.shape == (10,) and a.rate_Hz == 5000 and a.start_s == 2.5
assert (a.unit, a.direction, a.sensitivity, a.name) == ('m/s²', '-Y', 0.0125, 'accel_1x')
assert m['recording'].speed_rpm == 604.5 and m['recording'].rvbench_status == 'ok'
assert m['input_torque'].unit == 'N·m'

head = open('mat73', 'rb').read(128)
assert head[:10] == b'MATLAB 7.3' and head[124:] == b'\x00\x02IM'
f = h5py.File('mat73', 'r')
assert f.userblock_size == 512
a = f['accel_1x']
assert a.attrs['MATLAB_class'] == b'struct' and a['data'].attrs['MATLAB_class'] == b'double'
assert a['data'].shape == (1, 10) and (a['data'][0] == ramp).all()  # a column in MATLAB
assert {b''.join(n).decode() for n in a.attrs['MATLAB_fields']} == set(a.keys())
text = lambda d: ''.join(map(chr, d[:, 0]))
assert a['unit'].attrs['MATLAB_class'] == b'char' and a['unit'].attrs['MATLAB_int_decode'] == 2
assert text(a['unit']) == 'm/s²' and text(f['recording/rvbench_status']) == 'ok'

rate, data = scipy.io.wavfile.read('wav')
assert rate == 5000 and data.dtype == 'float32' and data.shape == (10, 2)
assert (data[:, 0] == ramp).all()
)";
  CHECK(runs("cd '" + scratch.path().string() + "' && /usr/bin/python3 look.py"));
}

TEST_CASE("the program flac decodes what was exported, to its checksum", "[hal][formats][export]") {
  if (!is_there("flac", "flac --version && metaflac --version")) return;
  const ScratchFolder scratch;
  written_as("flac", scratch / "a.flac", {exported()});
  const std::string file = "'" + (scratch / "a.flac").string() + "'";
  CHECK(runs("flac --silent --test " + file));
  CHECK(runs("metaflac --list " + file + " | grep -q 'unit_1=m/s²'"));
  CHECK(runs("test $(metaflac --show-bps " + file + ") = 24"));
  // The peak is the last step before the clipping point.
  CHECK(runs("flac --silent --decode --stdout --force-raw-format --endian=big --sign=signed " +
             file + " | od -An -tx1 -w6 | tail -n 1 | grep -q '7f ff ff 7f ff ff'"));
}

}  // namespace rvbench::hal
