// What the steps of versions of limits say of each.

/** The newest step of that name; undefined if there is none. */
export const last_step = (version, step) => (version.steps ?? []).findLast((one) => one.step === step);

const activated_utc = (version) => last_step(version, "activated")?.utc ?? "";

/** "draft", "approved", "activated", or "replaced": another one of its plan was activated later. */
export function standing_of(version, versions) {
  const is_replaced = versions.some((other) => other.status === "activated" && other.plan === version.plan &&
    activated_utc(other) > activated_utc(version));
  return version.status === "activated" && is_replaced ? "replaced" : version.status;
}
