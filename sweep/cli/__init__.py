"""The command line: `verbs` has one function for each verb, `terminal` what a terminal shows."""
