# Sourced. core_seconds: CPU time of the commands of this script that have ended, user and system, in whole seconds.
core_seconds() {
  awk -v ticks="$(getconf CLK_TCK)" '{ print int(($16 + $17) / ticks) }' "/proc/$$/stat"
}
