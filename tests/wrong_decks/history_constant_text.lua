local h = history.constant{ value = true }
