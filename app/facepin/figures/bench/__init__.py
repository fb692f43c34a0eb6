"""What a drag frame costs."""
