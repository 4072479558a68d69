"""The layout `page`: one sheet as one would write it on the blackboard, and nothing behind it."""
