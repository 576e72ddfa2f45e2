"""Reference problems: our value at three meshes against a known truth (`make validate`)."""

from tests.studies.validation import beams, frames, joints, motion, touching

PROBLEMS = (
    *beams.PROBLEMS,
    *joints.PROBLEMS,
    *frames.PROBLEMS,
    *motion.PROBLEMS,
    *touching.PROBLEMS,
)
