"""Forces between two bodies of a bearing: normal laws, friction, lubricated lands.

_ball_kernels - balls without a cage where they meet each other, compiled
_belt_kernels - the oil film around a ball in its pocket, compiled
_cage_kernels - balls in pockets and the cage on its guiding lands, compiled
_film_kernels - a ball on a race over the film of a traction table, compiled
_friction_kernels - friction of a ball on a race by its law, and linearised, compiled
_implicit_kernels - friction that a step cannot resolve, made implicit, compiled
_kernels      - laws of the contacts, compiled: normal force, friction, motion of a point, films
_race_kernels - balls on races, compiled: where and how they meet, friction, forces
"""
