# Sourced by the commands that print what they spent. `spent WHAT` adds a line to $minutes: elapsed and
# processor minutes since the last call, and the share of the processors that nobody else used.
minutes=""
minutes_scratch=$(mktemp)
trap 'rm -f "$minutes_scratch"' EXIT

# Processor seconds that the machine has been busy, for anybody.
busy_s() { awk '$1 == "cpu" { print ($2 + $3 + $4 + $7 + $8 + $9) / 100 }' /proc/stat; }

# Adds a line with the sums of those above it; REMARK stands behind them.
sum_of_minutes() {
  minutes+=$(awk -v remark="${1:+; $1}" '{ cpu += $2; elapsed += $4 } END {
    printf "%-9s %6.1f CPU-min %6.1f min elapsed%s", "in all", cpu, elapsed, remark }' <<<"${minutes%$'\n'}")$'\n'
}

since_s=$EPOCHREALTIME since_cpu_s=0 since_busy_s=$(busy_s)
spent() {
  local now_s=$EPOCHREALTIME now_busy_s now_cpu_s
  times >"$minutes_scratch"  # in a pipe it would be another shell's
  now_cpu_s=$(awk -F'[ms ]+' '{ sum += 60 * ($1 + $3) + $2 + $4 } END { printf "%.2f", sum }' "$minutes_scratch")
  now_busy_s=$(busy_s)
  minutes+=$(awk -v what="$1" -v elapsed="$now_s $since_s" -v cpu="$now_cpu_s $since_cpu_s" \
    -v busy="$now_busy_s $since_busy_s" -v cores="$(nproc)" '
    function since(text, parts) { split(text, parts, " "); return parts[1] - parts[2] }
    BEGIN {
      others = (since(busy) - since(cpu)) / (cores * since(elapsed) + 0.001)
      printf "%-9s %6.1f CPU-min %6.1f min elapsed, processors %3.0f %% free", what,
        since(cpu) / 60, since(elapsed) / 60, 100 * (others < 0 ? 1 : others > 1 ? 0 : 1 - others)
    }')$'\n'
  since_s=$now_s since_cpu_s=$now_cpu_s since_busy_s=$now_busy_s
}
