# Sourced, from the folder of the project, by the commands that build: `alone PRESET` waits until no other
# one of them is at work on that preset in this folder. It ends with the command; what the command starts
# does not keep it where its file, 9, is closed.
alone() {
  mkdir -p build
  exec 9>"build/$1.lock"
  flock -n 9 || {
    echo "Another command is at work in build/$1: waiting for it" >&2
    flock 9
  }
}
