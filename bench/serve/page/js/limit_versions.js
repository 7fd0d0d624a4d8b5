// What the steps of versions of limits say of each.

/** The newest step of that name; undefined if there is none. */
export const last_step = (version, step) => (version.steps ?? []).findLast((one) => one.step === step);

/** "draft", "approved", "activated", "replaced" (another one of its plan was activated later),
 *  "damaged" or "missing". */
export const standing_of = (version) =>
  version.status === "activated" && !version.in_force ? "replaced" : version.status;

/** What a limit is of; undefined if of every part. */
export const part_of = (limit) => limit.of ?? limit.component;
