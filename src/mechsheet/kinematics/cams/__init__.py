"""The motion of a follower over the angle of its cam, and the profile that does it."""
