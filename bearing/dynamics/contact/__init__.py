"""Forces between two bodies of a bearing: normal laws, friction, lubricated lands."""
